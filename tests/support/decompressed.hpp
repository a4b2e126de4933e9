#pragma once

#include <zlib.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "io/fields/vtk_encoding.hpp"

namespace perilink::test {

/// Returns the bytes of a zlib stream in base64, as browsers decompress it.
inline std::string decompressed(std::string_view base64) {
  const auto packed = decode_base64(base64);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib cannot begin");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  int status = Z_OK;
  while (status == Z_OK) {
    char block[4096];
    stream.next_out = reinterpret_cast<Bytef*>(block);
    stream.avail_out = sizeof block;
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.append(block, sizeof block - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("the stream is damaged");
  return bytes;
}

}  // namespace perilink::test
