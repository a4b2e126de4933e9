#include "io/fields/animated_png.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "support/tiny_png.hpp"

namespace perilink {
namespace {

TEST(AnimatedPng, HasAFrameOfEachPicture) {
  const std::vector<std::string> pictures = {test::tiny_png(3, "first"),
                                             test::tiny_png(3, "second")};
  const std::string size = test::png_number(1) + test::png_number(3) + std::string(8, '\0');
  const std::string after("\x03\xe8\0\0", 4);  // of 1000 in a second; frames replace each other
  const std::string expected =
      "\x89PNG\r\n\x1a\n" +
      test::png_chunk("IHDR",
                      test::png_number(1) + test::png_number(3) + std::string("\x08\0\0\0\0", 5)) +
      test::png_chunk("acTL", test::png_number(2) + test::png_number(0)) +
      test::png_chunk("fcTL", test::png_number(0) + size + std::string("\0\x64", 2) + after) +
      test::png_chunk("IDAT", "first") +
      test::png_chunk("fcTL", test::png_number(1) + size + std::string("\x01\xf4", 2) + after) +
      test::png_chunk("fdAT", test::png_number(2) + "second") + test::png_chunk("IEND", "");
  EXPECT_EQ(animated_png(pictures, 100), expected);
}

TEST(AnimatedPng, RefusesWhatDoesNotFit) {
  const std::string picture = test::tiny_png(3, "first");
  for (const std::string& other : {test::tiny_png(4, "first"), std::string("no picture"),
                                   picture.substr(0, picture.size() - 5), picture.substr(0, 20)}) {
    EXPECT_THROW(animated_png(std::vector<std::string>{picture, other}, 100),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace perilink
