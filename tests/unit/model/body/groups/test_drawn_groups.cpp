#include "model/body/groups/drawn_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "model/from_case/configure.hpp"
#include "support/replaced.hpp"

namespace perilink {
namespace {

using ::testing::Each;
using ::testing::Gt;
using ::testing::HasSubstr;

/// Regions and interfaces would lose their parts outside the mesh.
TEST(DrawnGroups, LinesBesideTheMeshAreNoneOfAGroup) {
  const CaseFile input;
  Body body;
  Group group{"joint", {}, {}};
  group.lines = {0, 1};
  EXPECT_NO_THROW(refuse_loose_group(input, "interfaces[1].group", body, group));
  group.loose = Vector3{20.0, 30.0, 0.0};
  try {
    refuse_loose_group(input, "interfaces[1].group", body, group);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("interfaces[1].group: is \"joint\", a line of which, at (20, 30), is "
                          "not an edge of a cell"));
  }
}

/// A plate of 4 x 2 with a line of the mesh from (2, 0) to (2, 1).
constexpr const char* drawn_case = R"(regions = [
  {name = "plate", group = "plate"},
  {name = "left", group = "left"},
  {name = "right", group = "right"},
]
[body]
mesh = "plate_22.msh"
horizon_ratio = 3
surface = "none"
[[materials]]
region = "plate"
youngs_modulus = 100
fracture_energy = 1
[[supports]]
region = "left"
fix = ["x", "y"]
[[displacements]]
region = "right"
x = 1
[[cracks]]
group = "crack"
)";

Model drawn_model(const std::string& text) {
  return build_model(parse_case(text, PERILINK_SOURCE_DIR "/tests/data/case.toml"));
}

std::string drawn_refusal(const std::string& text) {
  try {
    drawn_model(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DrawnGroups, ACrackOfAGroupCutsWhatItsPointsCut) {
  const Model drawn = drawn_model(drawn_case);
  const Model given =
      drawn_model(replaced(drawn_case, "group = \"crack\"", "points = [[2, 0], [2, 1]]"));
  ASSERT_EQ(drawn.cracks.size(), 1u);
  EXPECT_EQ(drawn.cracks[0].points, (std::vector<Vector3>{{2, 0, 0}, {2, 1, 0}}));
  EXPECT_GT(drawn.network.report.cut_by_crack[0], 0);
  EXPECT_EQ(drawn.network.report.cut_by_crack, given.network.report.cut_by_crack);
  EXPECT_EQ(drawn.network.stiffness, given.network.stiffness);
}

TEST(DrawnGroups, CracksNameAGroupOfTheMesh) {
  EXPECT_THAT(drawn_refusal(replaced(drawn_case, "group = \"crack\"", "group = \"creck\"")),
              ::testing::AllOf(HasSubstr("cracks[1].group: is \"creck\", but no Physical Curve of "
                                         "this name"),
                               HasSubstr("did you mean `crack`?")));
  EXPECT_THAT(drawn_refusal(replaced(drawn_case, "group = \"crack\"", "group = \"left\"")),
              HasSubstr("cracks[1].group: crosses no bond of the body"));
}

/// The surface between the cubes of a block, of quadrilaterals that are divided as their cells.
TEST(DrawnGroups, ACrackOfASurfaceInSpaceCutsItsBonds) {
  const Model model = drawn_model(R"(regions = [
  {name = "block", group = "block"},
  {name = "left", x = [0, 0], y = [0, 1], z = [0, 1]},
  {name = "right", x = [2, 2], y = [0, 1], z = [0, 1]},
]
[body]
problem = "three_dimensional"
mesh = "block_cracked.inp"
horizon_ratio = 2
surface = "none"
[[materials]]
region = "block"
youngs_modulus = 100
fracture_energy = 1
closing = false
[[supports]]
region = "left"
fix = ["x", "y", "z"]
[[supports]]
region = "right"
fix = ["y", "z"]
[[displacements]]
region = "right"
x = 1
[[cracks]]
group = "joint"
)");
  ASSERT_EQ(model.cracks.size(), 4u) << "two of four squares, from the lower side up";
  EXPECT_THAT(model.entry_of_crack, Each(0u));
  EXPECT_THAT(model.network.report.cut_by_crack, Each(Gt(0)));
  const Network& network = model.network;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const auto from = network.particles.position(network.bonds.first[b]);
    const auto to = network.particles.position(network.bonds.second[b]);
    if (std::abs(to[0] - from[0]) < 0.9) continue;
    const double along = (1.0 - from[0]) / (to[0] - from[0]);
    if (along < 0.01 || along > 0.99) continue;  // ends on the plane of the crack
    EXPECT_GE(from[2] + along * (to[2] - from[2]), 0.499) << "crosses the crack";
  }
}

}  // namespace
}  // namespace perilink
