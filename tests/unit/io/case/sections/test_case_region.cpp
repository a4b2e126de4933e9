#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/case/sections/case_sections.hpp"
#include "support/case_texts.hpp"

// The refusals are data: tests/cli/malformed.

namespace perilink {
namespace {

Region last_region(const std::string& text, const std::string& lines) {
  return parse_case(text + "[[regions]]\nname = \"new\"\n" + lines, "").regions.back();
}

TEST(CaseRegion, ReadsADisc) {
  const Region disc = last_region(small_case, "center = [3, -4]\nradius = 2\n");
  ASSERT_TRUE(disc.round.has_value());
  EXPECT_EQ(disc.round->center, (Vector3{3.0, -4.0, 0.0}));
  EXPECT_EQ(disc.round->radius, 2.0);
  EXPECT_FALSE(disc.round->axis);
  EXPECT_EQ(disc.box.lower, (Vector3{1.0, -6.0, 0.0}));
  EXPECT_EQ(disc.box.upper, (Vector3{5.0, -2.0, 0.0}));
}

TEST(CaseRegion, ReadsBallsAndCylinders) {
  const Region ball = last_region(full_case, "center = [1, 2, 3]\nradius = 1\n");
  EXPECT_EQ(ball.round->center, (Vector3{1.0, 2.0, 3.0}));
  EXPECT_EQ(ball.box.upper, (Vector3{2.0, 3.0, 4.0}));
  const Region along_y = last_region(full_case, "center = [1, 3]\nradius = 0.5\ny = [-1, 7]\n");
  EXPECT_EQ(along_y.round->axis, 1);
  EXPECT_EQ(along_y.round->center, (Vector3{1.0, 0.0, 3.0})) << "x and z are given";
  EXPECT_EQ(along_y.box.lower, (Vector3{0.5, -1.0, 2.5}));
  EXPECT_EQ(along_y.box.upper, (Vector3{1.5, 7.0, 3.5}));
}

TEST(CaseRegion, IsWrittenAsItWasRead) {
  for (const std::string lines :
       {"center = [1, 2, 3]\nradius = 0.1\n", "z = [-1, 7]\ncenter = [1, 3]\nradius = 0.5\n",
        "x = [0, 1]\ny = [2, 3]\nz = [4, 5]\n"}) {
    TomlWriter out;
    write_region(out, last_region(full_case, lines), 3);
    EXPECT_EQ(out.take(), "\n[[regions]]\nname = \"new\"\n" + lines);
  }
}

}  // namespace
}  // namespace perilink
