#include "model/surface_of_case.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/model_regions.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;

Index particle_at(const Model& model, double x, double y) {
  const std::array<double, 2> point{x, y};
  return nearest_particle(model.network.particles, point).particle;
}

TEST(SurfaceOfCase, KnowsNormalsLoadsAndSupports) {
  const Model model = build_model(strip_case());
  const SurfaceConditions& surface = model.surface_conditions;
  EXPECT_EQ(surface.particles.size(), 24u) << "5 by 9 particles";
  EXPECT_TRUE(surface.normal(particle_at(model, 20, 40)).empty());
  const auto side = surface.normal(particle_at(model, 0, 40));
  ASSERT_EQ(side.size(), 2u);
  EXPECT_DOUBLE_EQ(side[0], -1.0);
  EXPECT_DOUBLE_EQ(side[1], 0.0);
  const auto corner = surface.normal(particle_at(model, 40, 80));
  EXPECT_NEAR(corner[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(corner[1], std::sqrt(0.5), 1e-15);

  EXPECT_EQ(surface.unloaded[particle_at(model, 0, 40)], 3);
  EXPECT_EQ(surface.unloaded[particle_at(model, 20, 40)], 3);
  EXPECT_EQ(surface.unloaded[particle_at(model, 0, 70)], 1) << "loaded along y";
  EXPECT_EQ(surface.unloaded[particle_at(model, 0, 10)], 0) << "held";
}

TEST(SurfaceOfCase, CountsLoadsOfLaterStagesAndBars) {
  CaseFile input = parse_case(std::string(test::strip_text) + R"(stage = "first"
[[stages]]
name = "first"
to = 1

[[stages]]
name = "second"
to = 1

[[loads]]
region = "middle"
force = [1, 0]
stage = "second"

[[rebar]]
from = [10, 25]
to = [10, 35]
area = 1.0
youngs_modulus = 29000
yield_strength = 60
)",
                              "strip.toml");
  const Model model = build_model(input);
  EXPECT_EQ(model.surface_conditions.unloaded[particle_at(model, 40, 40)], 2);
  EXPECT_EQ(model.surface_conditions.unloaded[particle_at(model, 10, 30)], 0);
  EXPECT_EQ(model.surface_conditions.unloaded[particle_at(model, 40, 50)], 3);
}

TEST(SurfaceOfCase, KnowsNothingWithInertiaOrUncalibratedBonds) {
  CaseFile input = strip_case();
  input.materials[0].density = 1.0;
  input.analysis.type = AnalysisType::relaxation;
  EXPECT_TRUE(surface_of_case(input, build_model(strip_case())).empty());
  input = strip_case();
  input.body.surface = Surface::none;
  EXPECT_TRUE(build_model(input).surface_conditions.empty());
}

}  // namespace
}  // namespace perilink
