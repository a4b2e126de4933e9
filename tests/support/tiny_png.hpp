#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace perilink::test {

/// Returns the checksum of a chunk of a PNG file: CRC-32 of ISO 3309, bit by bit.
inline std::uint32_t png_checksum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? sum >> 1 ^ 0xedb88320U : sum >> 1;
  }
  return ~sum;
}

inline std::string png_number(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xffU);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return png_number(static_cast<std::uint32_t>(data.size())) + type + data +
         png_number(png_checksum(type + data));
}

/// Returns a file of the parts of PNG with one grey pixel a row.
/// \param pixels  contents of the chunk IDAT, as they are
inline std::string tiny_png(std::uint32_t height, const std::string& pixels) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", png_number(1) + png_number(height) + std::string("\x08\0\0\0\0", 5)) +
         png_chunk("IDAT", pixels) + png_chunk("IEND", "");
}

}  // namespace perilink::test
