#include "app/plot/plot_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(PlotLines, HaveMarksAndNames) {
  const std::vector<MarkedLine> lines = {{"a < b", {{10, 20}, {30, 40}}}, {"second", {{50, 60}}}};
  Svg svg(200, 100);
  draw_marked_lines(svg, lines, {100, 0});
  const std::string text = svg.str();
  EXPECT_THAT(text, HasSubstr(">a &lt; b<"));
  EXPECT_THAT(text, HasSubstr(">second<"));
  EXPECT_THAT(text, HasSubstr("cx=\"10"));
  EXPECT_THAT(text, HasSubstr("cx=\"30"));
}

TEST(PlotLines, NeedRoomForTheLongestName) {
  const std::vector<MarkedLine> one = {{"abc", {}}}, two = {{"abcdef", {}}, {"a", {}}};
  EXPECT_GT(room_of_lines(two).x, room_of_lines(one).x);
  EXPECT_GT(room_of_lines(two).y, room_of_lines(one).y);
}

}  // namespace
}  // namespace perilink
