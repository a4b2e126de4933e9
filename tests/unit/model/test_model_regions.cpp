#include "model/model_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/halved_meshes.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

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

/// A row of particles at 0, 1, 2 and 5. As an edge of a finite element the last bond is
/// the spacing at both of its ends.
TEST(ModelRegions, SpacingsAreThoseOfBondsOrEdgesAround) {
  Model model;
  model.lattice.spacing = 1.5;
  Network& network = model.network;
  network.particles.dim = 2;
  network.particles.positions = {0, 0, 1, 0, 2, 0, 5, 0};
  network.particles.kind.assign(4, ParticleKind::solid);
  network.particles.volumes.assign(4, 1.0);
  for (Index i = 0; i < 3; ++i) network.bonds.append(network.particles, i, i + 1);
  network.first_slip_spring = 3;
  const auto spacings = [&] {
    std::vector<double> all;
    for (Index i = 0; i < 4; ++i) all.push_back(spacing_around(model, i));
    return all;
  };
  EXPECT_EQ(spacings(), (std::vector<double>{1.5, 1.5, 1.5, 3.0}));
  network.cells.emplace().num_edges = 1;
  EXPECT_EQ(spacings(), (std::vector<double>{1.5, 1.5, 3.0, 3.0}));
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
  bar.bond.type = RebarBond::concrete;
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

/// A group of points holds the nodes there, one of lines those along them, and the surface its own.
TEST(ModelRegions, HoldBarNodesOnPointsLinesAndTheSurface) {
  CaseFile input = strip_case();
  RebarSection bar;
  bar.points = {{15.0, 0.0, 0.0}, {15.0, 60.0, 0.0}};
  bar.bond.type = RebarBond::linear;
  bar.bond.stiffness = 1.0;
  bar.youngs_modulus = 29000.0;
  bar.area = 1.0;
  input.rebar.push_back(bar);
  Model model = build_model(input);
  model.groups = {{"point", {}, {}, {15, 60, 0}}, {"line", {}, {}, {15, 5, 0, 15, 35, 0}, {0, 1}}};
  const auto nodes_in = [&](const std::string& group) {
    input.regions[3].group = group;
    return particles_of_region(input, model, "middle", "k");
  };
  const std::vector<Index> end = nodes_in("point");
  ASSERT_EQ(end.size(), 1u);
  EXPECT_EQ(model.network.particles.kind[end[0]], ParticleKind::rebar);
  EXPECT_DOUBLE_EQ(model.network.particles.position(end[0])[1], 60.0);
  EXPECT_EQ(nodes_in("line").size(), 3u);  // at y = 10, 20 and 30
  const std::vector<Index> surface = particles_of_region(input, model, "surface", "k");
  EXPECT_EQ(std::count_if(
                surface.begin(), surface.end(),
                [&](Index i) { return model.network.particles.kind[i] == ParticleKind::rebar; }),
            1);
}

/// Coordinates before test::turned().
Vector3 turned_back(std::span<const double> x) {
  Vector3 point{};
  std::copy(x.begin(), x.end(), point.begin());
  const double a = std::acos(-1.0) / 6.0, b = x.size() == 3 ? std::acos(-1.0) / 9.0 : 0.0;
  const double across = point[1] * std::cos(b) + point[2] * std::sin(b);
  return {point[0] * std::cos(a) + across * std::sin(a),
          across * std::cos(a) - point[0] * std::sin(a),
          point[2] * std::cos(b) - point[1] * std::sin(b)};
}

class RegionsOfGroups : public testing::TestWithParam<int> {};

/// A hundred bars at random places through the halves of a turned square or cube: groups of cells
/// and of sides hold the nodes that intervals along the body's own axes would.
TEST_P(RegionsOfGroups, HoldTheBarNodesThatIntervalsWould) {
  const int dim = GetParam(), count = dim == 2 ? 10 : 4;
  const double side = 10.0 * count, near = 1e-7 * side;
  const test::TemporaryDirectory directory;
  test::write_text(directory / "halves.msh", test::halved_mesh_text(dim, count, side));
  std::string text = fmt::format(
      "[body]\nproblem = \"{}\"\nmesh = \"halves.msh\"\nsurface = \"none\"\nhorizon_ratio = 2\n",
      dim == 3 ? "three_dimensional" : "plane_stress");
  const std::vector<std::string> groups = {"first", "second", "left", "right", "face"};
  for (const std::string& name : groups) {
    text += fmt::format("[[regions]]\nname = \"{0}\"\ngroup = \"{0}\"\n", name);
  }
  text +=
      "[[materials]]\nregions = [\"first\", \"second\"]\nyoungs_modulus = 100\n"
      "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n"
      "[[loads]]\nregion = \"right\"\nforce = [1, 0]\n[analysis]\ntype = \"elastic\"\n";
  if (dim == 3) {
    text.replace(text.find("\"y\"]"), 4, "\"y\", \"z\"]");
    text.replace(text.find("[1, 0]"), 6, "[1, 0, 0]");
  }
  std::mt19937 random(23);
  std::uniform_real_distribution<double> place(0.1 * side, 0.9 * side);
  for (int bar = 0; bar < 100; ++bar) {
    text += "[[rebar]]\nyoungs_modulus = 1000\narea = 1\npoints = [";
    const std::array<double, 3> from = {0.0, place(random), place(random)};
    const std::array<double, 3> middle = {0.5 * side, place(random), place(random)};
    std::array<double, 3> to = {side, place(random), place(random)};
    if (bar % 3 == 0) to[0] = place(random);
    for (const auto& point : {from, middle, to}) {
      const auto x = test::turned(dim == 2 ? std::array{point[0], point[1], 0.0} : point, dim);
      text += fmt::format("[{}], ", fmt::join(x.begin(), x.begin() + dim, ", "));
    }
    text += bar % 2 == 0 ? "]\nbond = \"concrete\"\n" : "]\n";
  }
  const CaseFile input = parse_case(text, (directory / "halves.toml").string());
  const Model model = draft_model(input);
  const Particles& particles = model.network.particles;
  const auto holds = [&](const std::string& name, double x) {
    if (name == "first") return x <= 0.5 * side + near;
    if (name == "second") return x >= 0.5 * side - near;
    const double at = name == "left" ? 0.0 : name == "right" ? side : 0.5 * side;
    return name == "surface" ? x <= near || x >= side - near : std::abs(x - at) <= near;
  };
  for (const std::string name : {"first", "second", "left", "right", "face", "surface"}) {
    std::vector<Index> wanted, held;
    for (Index i = 0; i < particles.size(); ++i) {
      const bool is_bar = particles.kind[i] == ParticleKind::rebar;
      if (is_bar && holds(name, turned_back(particles.position(i))[0])) wanted.push_back(i);
    }
    for (const Index i : particles_of_region(input, model, name, "supports[1]")) {
      if (particles.kind[i] == ParticleKind::rebar) held.push_back(i);
    }
    EXPECT_GE(wanted.size(), 30u) << name;
    EXPECT_EQ(held, wanted) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(PlaneAndSpace, RegionsOfGroups, testing::Values(2, 3));

TEST(ModelRegions, EmptyOnesAreRefusedAtTheKeyThatAsks) {
  CaseFile input = strip_case();
  input.regions[3].box = {{11.0, 31.0, 0.0}, {19.0, 39.0, 0.0}};
  input.loads[0].region = "middle";
  test::expect_refused(input, "loads[1].region", "no particle lies in the region \"middle\"");
  test::expect_refused(input, "loads[1].region", "the nearest one is 1.414 outside, at (10, 30)");
  input.loads[0].region = "upper end";
  input.supports[0].region = "middle";
  test::expect_refused(input, "supports[1].region", "the spacing is 10");
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
