#include "model/body/solid_boxes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;

double area(const std::vector<Box>& boxes) {
  double sum = 0.0;
  for (const Box& box : boxes) {
    sum += (box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]);
  }
  return sum;
}

TEST(SolidBoxes, AreTheRegionsWithoutTheHoles) {
  CaseFile input = strip_case();
  EXPECT_EQ(boxes_of(input, 0).size(), 1u);
  input.materials[0].holes = {"middle"};
  input.regions[3].box = {{10, 30, 0}, {30, 50, 0}};
  EXPECT_EQ(boxes_of(input, 0).size(), 4u);
  EXPECT_DOUBLE_EQ(area(boxes_of(input, 0)), 40.0 * 80.0 - 20.0 * 20.0);
  input.regions[3].box = {{30, 30, 0}, {90, 50, 0}};  // a notch from the right
  EXPECT_EQ(boxes_of(input, 0).size(), 3u);
  EXPECT_DOUBLE_EQ(area(boxes_of(input, 0)), 40.0 * 80.0 - 10.0 * 20.0);
  input.regions[3].box = {{40, 30, 0}, {90, 50, 0}};  // outside the strip
  EXPECT_EQ(boxes_of(input, 0).size(), 1u);
  input.materials[0].holes = {"strip"};
  test::expect_refused(input, "materials[1].holes", "remove all of the material");
}

/// Four boxes around a hole leave it open.
TEST(SolidBoxes, BodiesWithHolesAreThoseOfBoxesAroundThem) {
  std::string text = test::strip_text;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("[[materials]]",
          "[[regions]]\nname = \"hole\"\nx = [10, 30]\ny = [30, 50]\n"
          "[[materials]]");
  replace("youngs_modulus", "holes = [\"hole\"]\nyoungs_modulus");
  const Model holed = build_model(parse_case(text, "a.toml"));
  replace("[[materials]]",
          "[[regions]]\nname = \"left\"\nx = [0, 10]\ny = [0, 80]\n"
          "[[regions]]\nname = \"right\"\nx = [30, 40]\ny = [0, 80]\n"
          "[[regions]]\nname = \"below\"\nx = [10, 30]\ny = [0, 30]\n"
          "[[regions]]\nname = \"above\"\nx = [10, 30]\ny = [50, 80]\n"
          "[[materials]]");
  replace("region = \"strip\"", "regions = [\"left\", \"right\", \"below\", \"above\"]");
  replace("holes = [\"hole\"]\n", "");
  const Model boxes = build_model(parse_case(text, "a.toml"));
  EXPECT_EQ(holed.network.particles.size(), 5 * 9 - 1);  // the middle of the hole
  EXPECT_EQ(holed.network.particles.positions, boxes.network.particles.positions);
  EXPECT_EQ(holed.network.particles.volumes, boxes.network.particles.volumes);
  EXPECT_EQ(holed.network.bonds.first, boxes.network.bonds.first);
  EXPECT_EQ(holed.network.bonds.second, boxes.network.bonds.second);
}

}  // namespace
}  // namespace perilink
