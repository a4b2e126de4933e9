#include "model/unbreakable_path.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/from_case/configure.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// A bar of 80 by 16, held on the left and driven on the right, with a horizon of 6. Its parts
/// x <= 40 - zone / 2 and x >= 40 + zone / 2 are unbreakable up to y = 12.
Model bar(double zone, const std::string& more = "") {
  return build_model(parse_case(fmt::format(R"([body]
problem = "plane_stress"
spacing = 2
horizon_ratio = 3
[[regions]]
name = "bar"
x = [0, 80]
y = [0, 16]
[[regions]]
name = "a"
x = [0, {}]
y = [0, 12]
[[regions]]
name = "b"
x = [{}, 80]
y = [0, 12]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 12]
[[regions]]
name = "right"
x = [80, 80]
y = [0, 12]
[[materials]]
region = "bar"
youngs_modulus = 30000
fracture_energy = 0.1
[[materials]]
regions = ["a", "b"]
youngs_modulus = 30000
fracture_energy = "infinite"
{}[[supports]]
region = "left"
fix = ["x", "y"]
[[displacements]]
region = "right"
x = 1
)",
                                            40.0 - 0.5 * zone, 40.0 + 0.5 * zone, more),
                                "bar"));
}

bool has_note(const Model& model) {
  for (const std::string& note : model.notes) {
    if (note.find("unbreakable bonds join \"right\" and \"left\"") != std::string::npos)
      return true;
  }
  return false;
}

TEST(UnbreakablePath, IsNotedInAZoneOfTwoHorizonsAndLess) {
  EXPECT_TRUE(has_note(bar(8)));
  EXPECT_TRUE(has_note(bar(12)));
  EXPECT_FALSE(has_note(bar(16)));
}

/// The parts touch: the body does not fail by its material.
TEST(UnbreakablePath, IsNotNotedWhereUnbreakableParticlesJoin) {
  EXPECT_FALSE(has_note(bar(0)));
  EXPECT_FALSE(has_note(bar(8,
                            "[[regions]]\nname = \"edge\"\nx = [0, 80]\ny = [0, 2]\n"
                            "[[materials]]\nregion = \"edge\"\nyoungs_modulus = 30000\n"
                            "fracture_energy = \"infinite\"\n")));
}

/// Bonds across an interface break whatever their ends are made of.
TEST(UnbreakablePath, DoesNotLeadAcrossInterfaces) {
  EXPECT_FALSE(has_note(bar(0,
                            "[[interfaces]]\npoints = [[41, -1], [41, 17]]\n"
                            "fracture_energy = 0.05\n")));
}

TEST(UnbreakablePath, IsNotNotedInElasticAnalyses) {
  EXPECT_FALSE(has_note(bar(8, "[analysis]\ntype = \"elastic\"\n")));
}

}  // namespace
}  // namespace perilink
