#include "io/fields/compressed_text.hpp"

#include <gtest/gtest.h>

#include "support/decompressed.hpp"

namespace perilink {
namespace {

TEST(CompressedText, ComesBackByteForByte) {
  std::string text("\0\xff", 2);
  for (int k = 0; k < 5000; ++k) text += std::to_string(k % 7);
  const std::string packed = compress_to_base64(text);
  EXPECT_LT(packed.size(), text.size() / 10);
  EXPECT_EQ(test::decompressed(packed), text);
  EXPECT_EQ(test::decompressed(compress_to_base64("")), "");
}

// RFC 1950: the first byte names the method 8 and a window of 32 KiB, which "deflate" of browsers
// expects; raw deflate has no such header.
TEST(CompressedText, HasTheHeaderOfZlib) {
  const auto bytes = decode_base64(compress_to_base64("text"));
  EXPECT_EQ(std::to_integer<int>(bytes.at(0)), 0x78);
}

}  // namespace
}  // namespace perilink
