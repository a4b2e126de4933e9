#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// How VTK's XML files hold an array inline: zlib-compressed blocks in base64,
/// header_type="UInt64", compressor="vtkZLibDataCompressor".

namespace perilink {

std::string encode_base64(std::span<const std::byte> bytes);

/// \throws std::invalid_argument when the text is not base64
std::vector<std::byte> decode_base64(std::string_view text);

/// base64(header) followed by base64(all compressed blocks), where the header is 64-bit numbers:
/// blocks, bytes per block, bytes of a last partial block (0: it is full), compressed bytes of each
/// block.
std::string encode_array(std::span<const std::byte> bytes);

/// Inverse of encode_array.
/// \throws std::invalid_argument saying what is wrong
std::vector<std::byte> decode_array(std::string_view text);

}  // namespace perilink
