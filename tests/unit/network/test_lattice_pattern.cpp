#include "network/lattice_pattern.hpp"

#include <gtest/gtest.h>

#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using test::in_one_piece;
using test::network_input;

struct PatternCase {
  std::string name;
  Pattern pattern;
  Surface surface;
  Vector3 size;    // in spacings
  double horizon;  // in spacings
  bool micropolar = false;
};

std::ostream& operator<<(std::ostream& out, const PatternCase& own) { return out << own.name; }

LatticeInput input_of(const PatternCase& own) {
  LatticeInput input;
  input.pattern = own.pattern;
  input.surface = own.surface;
  input.spacing = 0.2;
  input.horizon = own.horizon * input.spacing;
  input.thickness = 0.7;
  input.solid = {{{0.3, -0.1, 0.0}, {0.0, 0.0, 0.0}}};
  for (int a = 0; a < 3; ++a) {
    input.solid[0].upper[a] = input.solid[0].lower[a] + own.size[a] * input.spacing;
  }
  input.material = {0};
  return input;
}

NetworkInput constants_of(const PatternCase& own, const LatticeInput& lattice) {
  NetworkInput input = network_input(lattice);
  if (!own.micropolar) return input;
  input.model = BondModel::micropolar;
  input.torsion = 0.7;
  input.materials[0].poissons_ratio = 0.1;
  return input;
}

LatticePattern make_pattern(const Body& body, const NetworkInput& input) {
  LatticePattern pattern = pattern_of(*grid_of(body), input.horizon);
  pattern.sample = build_network(body_of(pattern.small, body.lattice, input.thickness), input);
  return pattern;
}

class Patterns : public testing::TestWithParam<PatternCase> {};

/// The bonds and stiffnesses of bodies that are made in one piece, in their order. Positions differ
/// by round-off, 1e-16 of the body's size, and lengths by some 1e-15. Calibration starts from
/// families and finds the same bits here.
TEST_P(Patterns, GiveTheBondsOfTheWholeBody) {
  const LatticeInput lattice = input_of(GetParam());
  const NetworkInput input = constants_of(GetParam(), lattice);
  const Body body = make_body(lattice);
  const Network whole = build_network(body, in_one_piece(input));
  const LatticePattern pattern = make_pattern(body, input);
  const LatticeGrid& grid = pattern.grid;
  EXPECT_LT(pattern.sample.particles.size(), whole.particles.size());
  EXPECT_EQ(pattern.num_bonds(), whole.num_elements());
  EXPECT_EQ(pattern.sample.torsion, whole.torsion);
  Index own = 0;
  PatternBonds(pattern).for_each([&](const GridPoint& first, const GridPoint& second, Index e) {
    ASSERT_LT(own, whole.num_elements());
    EXPECT_EQ(grid.number(grid.all(), first), whole.bonds.first[own]);
    EXPECT_EQ(grid.number(grid.all(), second), whole.bonds.second[own]);
    EXPECT_NEAR(pattern.sample.stiffness[e], whole.stiffness[own], 1e-13 * whole.stiffness[own]);
    EXPECT_NEAR(pattern.sample.inflection_of(e), whole.inflection_of(own), 1e-13);
    if (whole.carries_moments()) {
      EXPECT_NEAR(pattern.sample.bending[e], whole.bending[own], 1e-13 * whole.bending[own]);
    }
    ++own;
  });
  EXPECT_EQ(own, whole.num_elements());
  const LatticeGrid& small = pattern.small;
  grid.for_each(grid.all(), [&](const GridPoint& point) {
    EXPECT_DOUBLE_EQ(
        pattern.sample.particles.volumes[small.number(small.all(), pattern.place(point))],
        whole.particles.volumes[grid.number(grid.all(), point)]);
  });
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Patterns,
    testing::Values(
        PatternCase{"PlaneUncorrected", Pattern::rectangular, Surface::none, {40, 7.3, 0}, 3},
        PatternCase{"Cubic", Pattern::cubic, Surface::calibrated, {4, 17, 23.4}, 2},
        PatternCase{"CubicByEnergy", Pattern::cubic, Surface::energy, {26, 4, 4}, 3},
        PatternCase{"FaceCentred", Pattern::face_centred, Surface::calibrated, {16, 5, 3}, 1.5},
        PatternCase{"FramesInSpace", Pattern::cubic, Surface::calibrated, {16, 5, 6}, 2, true}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace perilink
