#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// \file Inline arrays of VTK's XML files: zlib-compressed blocks in base64, header_type="UInt64",
///     compressor="vtkZLibDataCompressor".

namespace perilink {

std::string encode_base64(std::span<const std::byte> bytes);

/// \throws std::invalid_argument when the text is not base64
std::vector<std::byte> decode_base64(std::string_view text);

/// Returns base64(header) followed by base64(all compressed blocks). The header is of 64-bit
/// numbers: blocks, bytes per block, bytes of a partial last block (0: it is full), compressed
/// bytes per block.
std::string encode_array(std::span<const std::byte> bytes);

/// Decodes an array: the inverse of encode_array().
/// \throws std::invalid_argument  with the fault
std::vector<std::byte> decode_array(std::string_view text);

}  // namespace perilink
