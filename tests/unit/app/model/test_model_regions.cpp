#include "app/model/model_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

using test::strip_case;

TEST(ModelRegions, HoldTheParticlesOnTheirSidesInAscendingOrder) {
  CaseFile input = strip_case();
  const Model model = build_model(input);
  const std::vector<Index> upper = particles_of_region(input, model, "upper end", "loads[1]");
  EXPECT_EQ(upper.size(), 15u);  // three rows of five
  EXPECT_TRUE(std::is_sorted(upper.begin(), upper.end()));
  for (const Index i : upper) EXPECT_GE(model.network.particles.position(i)[1], 60.0);
}

TEST(ModelRegions, ForgiveRoundOffButNoMore) {
  CaseFile input = strip_case();
  const Model model = build_model(input);
  input.regions[3].box = {{0.0, 40.0 + 1e-9, 0.0}, {40.0, 45.0, 0.0}};
  EXPECT_EQ(particles_of_region(input, model, "middle", "loads[1]").size(), 5u);
  input.regions[3].box.lower[1] = 40.0 + 1e-3;
  EXPECT_THROW(particles_of_region(input, model, "middle", "loads[1]"), InputError);
}

TEST(ModelRegions, LeaveGhostsOut) {
  CaseFile input = strip_case();
  input.body.surface = Surface::ghost;
  const Model model = build_model(input);
  input.regions[3].box = {{-100.0, -100.0, 0.0}, {200.0, 200.0, 0.0}};
  const std::vector<Index> all = particles_of_region(input, model, "middle", "loads[1]");
  EXPECT_LT(all.size(), static_cast<std::size_t>(model.network.particles.size()));
  EXPECT_EQ(all.size(), 4u * 9u);  // cell-centred across, from the lowest row upwards
}

TEST(ModelRegions, HoldBarNodesToo) {
  CaseFile input = strip_case();
  RebarSection bar;
  bar.points = {{15.0, 5.0, 0.0}, {15.0, 75.0, 0.0}};
  bar.bond = RebarBond::concrete;
  bar.youngs_modulus = 29000.0;
  bar.area = 1.0;
  input.rebar.push_back(bar);
  const Model model = build_model(input);
  const std::vector<Index> upper = particles_of_region(input, model, "upper end", "supports[1]");
  EXPECT_EQ(upper.size(), 15u + 2u);  // nodes at y = 65 and 75
  input.regions[3].box = {{14.0, 33.0, 0.0}, {16.0, 37.0, 0.0}};
  const std::vector<Index> one = particles_of_region(input, model, "middle", "supports[1]");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(model.network.particles.kind[one[0]], ParticleKind::rebar);
}

TEST(ModelRegions, EmptyOnesAreRefusedAtTheKeyThatAsks) {
  CaseFile input = strip_case();
  input.regions[3].box = {{11.0, 31.0, 0.0}, {19.0, 39.0, 0.0}};
  input.loads[0].region = "middle";
  test::expect_refused(input, "loads[1].region", "no particle lies in the region \"middle\"");
  test::expect_refused(input, "loads[1].region", "the nearest one is 1.414 outside, at (10, 30)");
  input.loads[0].region = "upper end";
  input.supports[0].region = "middle";
  test::expect_refused(input, "supports[1].region", "10 apart");
  input.supports[0].region = "lower end";
  DisplacementSection driven;
  driven.region = "middle";
  driven.value[1] = 0.1;
  input.displacements.push_back(driven);
  test::expect_refused(input, "displacements[1].region", "\"middle\"");
}

TEST(ModelRegions, EveryCaseHasASurfaceAndABody) {
  const CaseFile input = strip_case();
  const Model model = build_model(input);
  EXPECT_EQ(particles_of_region(input, model, "body", "loads[1]").size(), 45u);
  const std::vector<Index> rim = particles_of_region(input, model, "surface", "loads[1]");
  EXPECT_EQ(rim.size(), 45u - 3u * 7u);
  EXPECT_TRUE(std::is_sorted(rim.begin(), rim.end()));
  EXPECT_EQ(facets_of_region(input, model, "surface", "tractions[1]").size(), 2u * (4u + 8u));
}

TEST(ModelRegions, CatchTheFacetsWhoseCentresLieInside) {
  CaseFile input = strip_case();
  const Model model = build_model(input);
  // The upper two cells: two facets on each side and four on top.
  EXPECT_EQ(facets_of_region(input, model, "upper end", "tractions[1]").size(), 8u);
  input.regions[3].box = {{40.0, 0.0, 0.0}, {40.0, 44.9, 0.0}};
  EXPECT_EQ(facets_of_region(input, model, "middle", "tractions[1]").size(), 4u) << "a line";
  input.regions[3].box.upper[1] = 45.0 - 1e-9;
  EXPECT_EQ(facets_of_region(input, model, "middle", "tractions[1]").size(), 5u) << "round-off";
}

TEST(ModelRegions, TheNearestParticleIsTheFirstOfEquals) {
  const Model model = build_model(strip_case());
  const std::vector<double> between = {15.0, 80.0};
  const NearestParticle nearest = nearest_particle(model.network.particles, between);
  EXPECT_EQ(nearest.particle, 41);  // the ninth row begins with 40
  EXPECT_DOUBLE_EQ(nearest.distance, 5.0);
}

TEST(ModelRegions, OfAPhysicalGroupAreItsParticlesAndFacets) {
  CaseFile input = strip_case();
  Model model = build_model(input);
  model.groups = {{"rim", {0, 1, 2}, {5}}, {"volume", {7}, {}}};
  input.regions[3].group = "rim";
  EXPECT_EQ(particles_of_region(input, model, "middle", "k"), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(facets_of_region(input, model, "middle", "k"), (std::vector<Index>{5}));
  input.regions[3].group = "volume";
  EXPECT_THROW(facets_of_region(input, model, "middle", "k"), InputError);
}

}  // namespace
}  // namespace perilink
