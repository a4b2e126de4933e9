#include "io/fields/compressed_text.hpp"

#include <zlib.h>

#include <span>
#include <stdexcept>
#include <vector>

#include "io/fields/vtk_encoding.hpp"

namespace perilink {

std::string compress_to_base64(std::string_view bytes) {
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> packed(length);
  const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &length,
                               reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::runtime_error("zlib cannot compress a text");
  return encode_base64(std::span(packed).first(length));
}

}  // namespace perilink
