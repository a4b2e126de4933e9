#include "io/fields/animated_png.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace perilink {
namespace {

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);

struct Chunk {
  std::string_view type, data;
};

/// Returns a number in network byte order.
template <class Number>
std::string in_bytes(Number number) {
  std::string bytes;
  for (int shift = 8 * (static_cast<int>(sizeof(Number)) - 1); shift >= 0; shift -= 8) {
    bytes += static_cast<char>(number >> shift & 0xff);
  }
  return bytes;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (const char byte : bytes.substr(at, 4)) {
    number = number << 8 | static_cast<unsigned char>(byte);
  }
  return number;
}

std::vector<Chunk> chunks_of(std::string_view picture) {
  const std::invalid_argument damaged("a picture is no whole PNG file");
  if (!picture.starts_with(signature)) throw damaged;
  constexpr std::size_t around = 12;  // bytes of length, type and checksum
  std::vector<Chunk> chunks;
  for (std::size_t at = signature.size(); at < picture.size();) {
    if (picture.size() - at < around) throw damaged;
    const std::size_t length = number_at(picture, at);
    if (picture.size() - at - around < length) throw damaged;
    chunks.push_back({picture.substr(at + 4, 4), picture.substr(at + 8, length)});
    at += around + length;
  }
  if (chunks.empty() || chunks.front().type != "IHDR" || chunks.front().data.size() < 8 ||
      chunks.back().type != "IEND") {
    throw damaged;
  }
  return chunks;
}

void append(std::string& file, std::string_view type, std::string_view data) {
  const std::string body = std::string(type).append(data);
  file += in_bytes(static_cast<std::uint32_t>(data.size()));
  file += body;
  file += in_bytes(static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}

}  // namespace

std::string animated_png(std::span<const std::string> pictures, int shown) {
  std::string file(signature);
  std::string_view header;
  std::uint32_t number = 0;  // of the chunks that belong to frames
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const std::vector<Chunk> chunks = chunks_of(pictures[k]);
    if (k == 0) {
      header = chunks.front().data;
    } else if (chunks.front().data != header) {
      throw std::invalid_argument("the pictures differ in size or kind of pixels");
    }
    const int length = std::min(shown * (k + 1 == pictures.size() ? 5 : 1), 0xffff);
    const std::string frame = std::string(header.substr(0, 8)) + std::string(8, '\0') +
                              in_bytes(static_cast<std::uint16_t>(length)) +
                              in_bytes(std::uint16_t{1000}) + std::string(2, '\0');
    bool is_begun = false;
    for (const Chunk& chunk : chunks) {
      const bool is_pixels = chunk.type == "IDAT";
      if (is_pixels && !is_begun) {
        append(file, "fcTL", in_bytes(number++) + frame);
        is_begun = true;
      }
      if (is_pixels && k > 0) {
        append(file, "fdAT", in_bytes(number++).append(chunk.data));
      } else if (is_pixels || (k == 0 && chunk.type != "IEND")) {
        append(file, chunk.type, chunk.data);
      }
      if (k == 0 && chunk.type == "IHDR") {
        append(file, "acTL",
               in_bytes(static_cast<std::uint32_t>(pictures.size())) + in_bytes(std::uint32_t{0}));
      }
    }
  }
  append(file, "IEND", "");
  return file;
}

}  // namespace perilink
