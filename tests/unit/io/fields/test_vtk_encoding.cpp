#include "io/fields/vtk_encoding.hpp"

#include <gtest/gtest.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace perilink {
namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// Test vectors of RFC 4648, section 10.
TEST(VtkEncoding, Base64AgreesWithTheStandard) {
  const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors) {
    EXPECT_EQ(encode_base64(bytes_of(plain)), coded);
    EXPECT_EQ(decode_base64(coded), bytes_of(plain));
  }
  EXPECT_THROW(decode_base64("Zg="), std::invalid_argument);
  EXPECT_THROW(decode_base64("Z!=="), std::invalid_argument);
  EXPECT_THROW(decode_base64("Zg==Zg=="), std::invalid_argument);
}

TEST(VtkEncoding, ArraysOfEveryLengthComeBack) {
  // Around the block size of 256 KiB: empty, partial, exactly full, one more.
  for (const std::size_t size : {0u, 1u, 1000u, 262143u, 262144u, 262145u, 600000u}) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * i / 7 % 251);
    EXPECT_EQ(decode_array(encode_array(bytes)), bytes) << size;
  }
}

TEST(VtkEncoding, DamagedArraysAreRefused) {
  const std::vector<std::byte> bytes(1000, std::byte{7});
  const std::string good = encode_array(bytes);
  EXPECT_THROW(decode_array(""), std::invalid_argument);
  EXPECT_THROW(decode_array(good.substr(0, 40)), std::invalid_argument);
  EXPECT_THROW(decode_array(good.substr(0, 44)), std::invalid_argument);
  EXPECT_THROW(decode_array(good.substr(0, 48)), std::invalid_argument);
  std::string huge = good;
  huge.replace(24, 6, "//////");  // bytes of the last block
  EXPECT_THROW(decode_array(huge), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
