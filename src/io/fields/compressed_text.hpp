#pragma once

#include <string>
#include <string_view>

namespace perilink {

/// Returns bytes as a zlib stream (RFC 1950) in base64, which browsers decompress as "deflate".
std::string compress_to_base64(std::string_view bytes);

}  // namespace perilink
