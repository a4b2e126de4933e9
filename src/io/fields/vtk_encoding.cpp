#include "io/fields/vtk_encoding.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "io/text/input_text.hpp"

namespace perilink {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18;
constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Returns the value of each base64 letter, and -1 for other characters.
constexpr std::array<std::int8_t, 256> make_letter_values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}
constexpr std::array<std::int8_t, 256> letter_values = make_letter_values();

std::size_t base64_length(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// \param out  compressBound() bytes
/// \return compressed bytes; 0 after a failure
std::size_t compress_block(std::span<const std::byte> block, std::byte* out) {
  uLongf length = compressBound(static_cast<uLong>(block.size()));
  // The fastest level: others take several times longer, and doubles get hardly smaller.
  const int status = compress2(reinterpret_cast<Bytef*>(out), &length,
                               reinterpret_cast<const Bytef*>(block.data()),
                               static_cast<uLong>(block.size()), Z_BEST_SPEED);
  return status == Z_OK ? length : 0;
}

struct BlockHeader {
  std::uint64_t blocks = 0;
  std::uint64_t block_size = 0;
  std::uint64_t last_size = 0;  ///< 0: the last block is full

  std::uint64_t size_of(std::uint64_t block) const {
    return block + 1 == blocks && last_size > 0 ? last_size : block_size;
  }
};

std::vector<std::uint64_t> decode_numbers(std::string_view text, std::size_t count) {
  const std::size_t length = base64_length(count * sizeof(std::uint64_t));
  if (text.size() < length) throw std::invalid_argument("the block header is cut off");
  const std::vector<std::byte> bytes = decode_base64(text.substr(0, length));
  if (bytes.size() != count * sizeof(std::uint64_t)) {
    throw std::invalid_argument("the block header has the wrong length");
  }
  std::vector<std::uint64_t> numbers(count);
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// Refuses headers that would allocate far more memory than the text can hold.
void check(const BlockHeader& header, std::size_t text_size) {
  constexpr std::uint64_t largest_ratio = 1100;  // zlib shrinks at most 1032-fold
  const bool absurd = header.blocks > text_size || header.last_size > header.block_size ||
                      (header.blocks > 0 && header.size_of(0) == 0) ||
                      (header.blocks > 0 && header.size_of(0) > largest_ratio * text_size);
  if (absurd) throw std::invalid_argument("the block header makes no sense");
}

}  // namespace

std::string encode_base64(std::span<const std::byte> bytes) {
  std::string text(base64_length(bytes.size()), '=');
  char* letter = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3, letter += 4) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k <= count; ++k) letter[k] = alphabet[group >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::vector<std::byte> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) throw std::invalid_argument("base64 text is cut off");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const bool last = i + 4 == text.size();
    const std::size_t pads =
        last ? static_cast<std::size_t>(text[i + 3] == '=') + (text[i + 2] == '=' ? 1U : 0U) : 0U;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool pad = k + pads >= 4;
      const int value = pad ? 0 : letter_values[static_cast<unsigned char>(text[i + k])];
      if (value < 0) throw std::invalid_argument("a character is not base64");
      group = group << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t k = 0; k + pads < 3; ++k) {
      bytes.push_back(static_cast<std::byte>(group >> (16 - 8 * k) & 255U));
    }
  }
  return bytes;
}

std::string encode_array(std::span<const std::byte> bytes) {
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes;
  std::vector<std::uint64_t> header(3 + blocks);
  header[0] = blocks;
  header[1] = block_bytes;
  header[2] = bytes.size() % block_bytes;
  const std::size_t room = compressBound(static_cast<uLong>(std::min(block_bytes, bytes.size())));
  std::vector<std::byte> compressed(blocks * room);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t start = b * block_bytes;
    header[3 + b] =
        compress_block(bytes.subspan(start, std::min(block_bytes, bytes.size() - start)),
                       compressed.data() + b * room);
  }
  std::size_t end = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    if (header[3 + b] == 0) throw std::runtime_error("zlib cannot compress a block");
    const std::byte* from = compressed.data() + b * room;
    std::copy(from, from + header[3 + b], compressed.data() + end);
    end += header[3 + b];
  }
  compressed.resize(end);
  return encode_base64(std::as_bytes(std::span(header))) + encode_base64(compressed);
}

std::vector<std::byte> decode_array(std::string_view text) {
  text = trimmed(text);
  const std::vector<std::uint64_t> start = decode_numbers(text, 3);
  const BlockHeader header{start[0], start[1], start[2]};
  check(header, text.size());
  const std::size_t header_count = 3 + static_cast<std::size_t>(header.blocks);
  const std::vector<std::uint64_t> sizes = decode_numbers(text, header_count);
  const std::vector<std::byte> compressed =
      decode_base64(text.substr(base64_length(header_count * sizeof(std::uint64_t))));

  std::vector<std::byte> bytes;
  std::size_t position = 0;
  for (std::uint64_t b = 0; b < header.blocks; ++b) {
    const std::uint64_t compressed_size = sizes[3 + b];
    if (compressed_size > compressed.size() - position) {
      throw std::invalid_argument("a compressed block is cut off");
    }
    const std::size_t begin = bytes.size();
    uLongf length = static_cast<uLongf>(header.size_of(b));
    bytes.resize(begin + length);
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data() + begin), &length,
                                  reinterpret_cast<const Bytef*>(compressed.data() + position),
                                  static_cast<uLong>(compressed_size));
    if (status != Z_OK || length != header.size_of(b)) {
      throw std::invalid_argument("a compressed block is damaged");
    }
    position += static_cast<std::size_t>(compressed_size);
  }
  return bytes;
}

}  // namespace perilink
