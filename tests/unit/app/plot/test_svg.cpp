#include "app/plot/svg.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <pugixml.hpp>

#include "base/error.hpp"

namespace perilink {
namespace {

TEST(SvgPath, StepsAreRelativeAndShort) {
  SvgPath path;
  path.move_to({10.0, 20.5});
  path.line_to({9.5, 20.504});
  path.dot({12.0, 20.0});
  EXPECT_EQ(path.data(), "m10 20.5l-.5 0m2.5-.5h0");
}

TEST(SvgPath, RoundingDoesNotAddUp) {
  SvgPath path;
  for (int k = 0; k < 3; ++k) path.line_to({k / 3.0, 0.0});  // 0, 0.33, 0.67: steps .33 and .34
  EXPECT_EQ(path.data(), "l0 0l.33 0l.34 0");
}

TEST(SvgPath, SquaresEndWhereTheyBegan) {
  SvgPath path;
  path.square({1.0, 1.0}, 2.0);
  path.square({4.0, 1.0}, 2.0);
  EXPECT_EQ(path.data(), "m0 0h2v2h-2zm3 0h2v2h-2z");
}

TEST(Svg, IsXmlWithTextEscaped) {
  Svg svg(100.0, 50.0);
  svg.open_group("stroke=\"#000\"");
  svg.line({0, 0}, {1, 1}, "");
  svg.circle({5, 5}, 2.25, "fill=\"none\"");
  svg.close_group();
  svg.path(SvgPath(), "");
  svg.text({1, 2}, "a < b & c", "middle", "");
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.str().c_str()));
  const pugi::xml_node root = document.child("svg");
  EXPECT_EQ(root.attribute("width").as_double(), 100.0);
  EXPECT_EQ(root.child("g").child("circle").attribute("r").as_double(), 2.25);
  EXPECT_FALSE(root.child("path"));
  EXPECT_STREQ(root.child("text").text().get(), "a < b & c");
}

TEST(Svg, IsXmlWhateverATitleHolds) {
  Svg svg(100.0, 50.0);
  svg.text({1, 2}, std::string("a\x1b[31m\x01\xff\0 b", 11), "middle", "");
  pugi::xml_document document;
  const std::string text = svg.str();
  ASSERT_TRUE(document.load_string(text.c_str()));
  EXPECT_STREQ(document.child("svg").child("text").text().get(), "a\\x1b[31m\\x01\\xff\\x00 b");
}

TEST(Svg, SavesWholeFilesOrSaysWhyNot) {
  const std::string path = testing::TempDir() + "perilink_" + std::to_string(::getpid()) + ".svg";
  Svg(10.0, 10.0).save(path);
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::remove(path);
  EXPECT_THROW(Svg(1.0, 1.0).save("/no/such/folder/x.svg"), FileError);
}

}  // namespace
}  // namespace perilink
