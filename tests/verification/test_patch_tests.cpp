// The linear patch test with calibrated bonds: uniform strains are equilibria, under tractions and
// under prescribed displacements of the surface. The bodies of the study of the same name that take
// seconds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "patch.hpp"

namespace perilink::verification {

/// Prints a body for GoogleTest.
void PrintTo(const PatchBody& body, std::ostream* out) { *out << body.name; }

namespace {

std::vector<PatchBody> quick_bodies() {
  std::vector<PatchBody> bodies = patch_bodies();
  std::erase_if(bodies, [](const PatchBody& body) {
    // Up to ten seconds each; the coarse one stays.
    return body.name.find("block") != std::string::npos && body.name != "l_block_coarse";
  });
  return bodies;
}

PatchBody body_named(const std::string& name) {
  const std::vector<PatchBody> bodies = patch_bodies();
  return *std::find_if(bodies.begin(), bodies.end(),
                       [&](const PatchBody& body) { return body.name == name; });
}

class Patch : public testing::TestWithParam<PatchBody> {};

TEST_P(Patch, UniformStrainsAreEquilibria) {
  const PatchResult result = run_patch(GetParam());
  EXPECT_LT(result.residual.force, patch_acceptance);
  EXPECT_LT(result.residual.moment, patch_acceptance);
  EXPECT_LT(result.traction_error, patch_acceptance);
  EXPECT_LT(result.displacement_error, patch_acceptance);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Patch, testing::ValuesIn(quick_bodies()),
                         [](const auto& tested) { return tested.param.name; });

/// Loads of a case are to round-off those that the study computes from the stress.
void expect_loads(const PatchBody& body, const std::string& loading,
                  Gradient (*stress_of)(const Model&)) {
  const Model model = patch_model(body, loading);
  const Loads expected = surface_loads(model, stress_of(model));
  double pull = 0.0;
  for (const double f : expected.forces) pull = std::max(pull, std::abs(f));
  ASSERT_GT(pull, 0.0);
  for (std::size_t k = 0; k < expected.forces.size(); ++k) {
    ASSERT_NEAR(model.loads.forces[k], expected.forces[k], 1e-13 * pull) << "component " << k;
  }
}

/// The case names neither lambda nor mu: plane stress, nu = 1/3 and E = 1 in closed form.
Gradient stress_of_case() {
  const Gradient g = patch_gradient(2);
  const double c = 1.0 / (1.0 - 1.0 / 9.0), nu = 1.0 / 3.0;
  const double shear = 0.5 / (1.0 + nu) * (g[0][1] + g[1][0]);
  return {{c * (g[0][0] + nu * g[1][1]), shear}, {shear, c * (g[1][1] + nu * g[0][0])}};
}

Gradient plane_stress_of_case(const Model&) { return stress_of_case(); }

/// A [[tractions]] entry for each side: `where` is the region's keys, n its outward normal.
std::string side(const std::string& name, const std::string& where, double nx, double ny) {
  const Gradient s = stress_of_case();
  return fmt::format(
      "[[regions]]\nname = \"{0}\"\n{1}\n"
      "[[tractions]]\nregion = \"{0}\"\ntraction = [{2:.17g}, {3:.17g}]\n",
      name, where, s[0][0] * nx + s[0][1] * ny, s[1][0] * nx + s[1][1] * ny);
}

TEST(PatchLoads, TractionsOnTheSidesOfABoxAreThoseOfTheStress) {
  expect_loads(body_named("rectangular_3"),
               side("left", "x = [0, 0]\ny = [0, 1]", -1, 0) +
                   side("right", "x = [1.5, 1.5]\ny = [0, 1]", 1, 0) +
                   side("bottom", "x = [0, 1.5]\ny = [0, 0]", 0, -1) +
                   side("top", "x = [0, 1.5]\ny = [1, 1]", 0, 1),
               plane_stress_of_case);
}

TEST(PatchLoads, TractionsOnTheGroupsOfAMeshAreThoseOfTheStress) {
  expect_loads(body_named("l_shape"),
               side("a", "group = \"left\"", -1, 0) + side("b", "group = \"right\"", 1, 0) +
                   side("c", "group = \"inner right\"", 1, 0) +
                   side("d", "group = \"bottom\"", 0, -1) + side("e", "group = \"top\"", 0, 1) +
                   side("f", "group = \"inner top\"", 0, 1),
               plane_stress_of_case);
}

TEST(PatchLoads, PressureAllAroundIsAnIsotropicStress) {
  for (const char* name : {"hexagonal_3", "disc", "plate_with_hole"}) {
    expect_loads(body_named(name), "[[tractions]]\nregion = \"surface\"\npressure = 1\n",
                 [](const Model&) {
                   return Gradient{{-1, 0}, {0, -1}};
                 });
  }
  expect_loads(body_named("cylinder"), "[[tractions]]\nregion = \"surface\"\npressure = 1\n",
               [](const Model&) {
                 return Gradient{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
               });
}

}  // namespace
}  // namespace perilink::verification
