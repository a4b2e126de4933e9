#include "network/lattice_pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

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

LatticePattern make_pattern(const Body& body, const NetworkInput& input) {
  LatticePattern pattern = pattern_of(*grid_of(body), input.horizon);
  pattern.sample = build_network(body_of(pattern.small, body.lattice, input.thickness), input);
  return pattern;
}

class Patterns : public testing::TestWithParam<PatternCase> {};

/// The stiffnesses that bodies have which are made in one piece, of all windows together each bond
/// once, or twice where it joins two. Positions differ by round-off, 1e-16 of the body's size, and
/// lengths so by some 1e-15 of themselves; calibration starts from families and finds the same
/// bits here.
TEST_P(Patterns, GiveTheBondsOfTheWholeBody) {
  const LatticeInput lattice = input_of(GetParam());
  NetworkInput input = network_input(lattice);
  const Body body = make_body(lattice);
  const Network whole = build_network(body, in_one_piece(input));
  const LatticePattern pattern = make_pattern(body, input);
  ASSERT_TRUE(can_repeat(pattern.sample));
  const LatticeGrid& grid = pattern.grid;
  EXPECT_LT(pattern.sample.particles.size(), whole.particles.size());
  EXPECT_EQ(pattern.num_bonds(), whole.num_elements());
  std::map<std::pair<Index, Index>, double> expected;
  for (Index e = 0; e < whole.num_elements(); ++e) {
    expected[{whole.bonds.first[e], whole.bonds.second[e]}] = whole.stiffness[e];
  }
  const PatternBonds bonds(pattern);
  for (const int parts : {1, 4}) {
    Index inside = 0, across = 0;
    for (const GridWindow& window : split_grid(grid, parts)) {
      bonds.for_each(window, [&](const GridPoint& first, const GridPoint& second, Index e) {
        const Index i = grid.number(grid.all(), first), j = grid.number(grid.all(), second);
        ASSERT_EQ(expected.count({i, j}), 1u);
        const double stiffness = expected[{i, j}];
        EXPECT_NEAR(pattern.sample.stiffness[e], stiffness, 1e-13 * stiffness);
        ++(window.contains(first) && window.contains(second) ? inside : across);
      });
    }
    EXPECT_EQ(inside + across / 2, whole.num_elements());
    EXPECT_EQ(across > 0, parts > 1);
  }
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
        PatternCase{"PlaneByEnergy", Pattern::rectangular, Surface::energy, {23, 22, 0}, 3},
        PatternCase{"Cubic", Pattern::cubic, Surface::calibrated, {4, 17, 23.4}, 2},
        PatternCase{"CubicUncorrected", Pattern::cubic, Surface::none, {16, 17, 3}, 2},
        PatternCase{"CubicByEnergy", Pattern::cubic, Surface::energy, {26, 4, 4}, 3},
        PatternCase{"FaceCentred", Pattern::face_centred, Surface::calibrated, {16, 5, 3}, 1.5},
        PatternCase{
            "FaceCentredUncorrected", Pattern::face_centred, Surface::none, {15.7, 5, 3}, 1.5}),
    [](const auto& instance) { return instance.param.name; });

TEST(Pattern, DoesNotRepeatWhatIsNotAlike) {
  // A plane that is calibrated as a whole, a particle that one bond holds, frames.
  PatternCase plane{"", Pattern::rectangular, Surface::calibrated, {9, 9, 0}, 2};
  const LatticeInput lattice = input_of(plane);
  NetworkInput input = network_input(lattice);
  EXPECT_FALSE(can_repeat(build_network(make_body(lattice), input)));
  plane.surface = Surface::none;
  const LatticeInput uncorrected = input_of(plane);
  EXPECT_TRUE(can_repeat(build_network(make_body(uncorrected), input)));
  input.horizon = lattice.spacing;
  Network loose = build_network(make_body(uncorrected), input);
  for (Index e = 0; e < loose.num_elements(); ++e) {
    if (loose.bonds.first[e] == 0 && loose.bonds.second[e] == 1) loose.stiffness[e] = 0.0;
  }
  EXPECT_FALSE(can_repeat(loose));
  input.horizon = lattice.horizon;
  input.model = BondModel::micropolar;
  input.materials[0].poissons_ratio = 0.1;
  EXPECT_FALSE(can_repeat(build_network(make_body(uncorrected), input)));
}

}  // namespace
}  // namespace perilink
