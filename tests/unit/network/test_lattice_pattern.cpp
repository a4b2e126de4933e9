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
  bool micropolar = false;
  std::vector<Crack> cracks = {};
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
  input.cracks = own.cracks;
  if (!own.micropolar) return input;
  input.model = BondModel::micropolar;
  input.torsion = 0.7;
  input.materials[0].poissons_ratio = 0.1;
  return input;
}

/// A pattern without cracks.
LatticePattern make_pattern(const Body& body, NetworkInput input) {
  LatticePattern pattern = pattern_of(*grid_of(body), input.horizon);
  input.cracks.clear();
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
  const NetworkInput input = constants_of(GetParam(), lattice);
  const Body body = make_body(lattice);
  const Network whole = build_network(body, in_one_piece(input));
  LatticePattern pattern = make_pattern(body, input);
  ASSERT_TRUE(can_repeat(pattern.sample));
  std::vector<Index> by_crack;
  ASSERT_TRUE(cut_bonds(pattern, input.cracks, by_crack));
  EXPECT_EQ(by_crack, whole.cut_by_crack);
  const LatticeGrid& grid = pattern.grid;
  EXPECT_LT(pattern.sample.particles.size(), whole.particles.size());
  EXPECT_EQ(pattern.num_bonds(), whole.num_elements());
  std::map<std::pair<Index, Index>, Index> elements;
  for (Index e = 0; e < whole.num_elements(); ++e) {
    elements[{whole.bonds.first[e], whole.bonds.second[e]}] = e;
  }
  EXPECT_EQ(pattern.sample.torsion, whole.torsion);
  const PatternBonds bonds(pattern);
  for (const int parts : {1, 4}) {
    Index inside = 0, across = 0;  // every bond once, those between parts twice
    for (const GridWindow& window : split_grid(grid, parts)) {
      bonds.for_each(window, [&](const GridPoint& first, const GridPoint& second, Index e) {
        const Index i = grid.number(grid.all(), first), j = grid.number(grid.all(), second);
        ASSERT_EQ(elements.count({i, j}), 1u);
        const Index own = elements[{i, j}];
        EXPECT_NEAR(pattern.sample.stiffness[e], whole.stiffness[own],
                    1e-13 * whole.stiffness[own]);
        EXPECT_NEAR(pattern.sample.inflection_of(e), whole.inflection_of(own), 1e-13);
        if (whole.carries_moments()) {
          EXPECT_NEAR(pattern.sample.bending[e], whole.bending[own], 1e-13 * whole.bending[own]);
        }
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
            "FaceCentredUncorrected", Pattern::face_centred, Surface::none, {15.7, 5, 3}, 1.5},
        PatternCase{"Frames", Pattern::rectangular, Surface::energy, {23, 12, 0}, 3, true},
        PatternCase{"FramesInSpace", Pattern::cubic, Surface::calibrated, {16, 5, 6}, 2, true},
        PatternCase{"PlaneWithCracks",
                    Pattern::rectangular,
                    Surface::none,
                    {40, 7.3, 0},
                    3,
                    false,
                    {{{{3.1, -1, 0}, {3.1, 0.7, 0}, {3.3, 0.9, 0}}},  // along a row of particles
                     {{{1.0, 5, 0}, {2.43, 0.85, 0}}}}},
        PatternCase{"SpaceWithACrack",
                    Pattern::cubic,
                    Surface::calibrated,
                    {17, 5, 4},
                    2,
                    false,
                    {{{{1.5, -1, -1}, {2.0, -1, 2}, {2.0, 0.4, 2}, {1.5, 0.4, -1}}}}},
        PatternCase{"FaceCentredFramesWithACrack",
                    Pattern::face_centred,
                    Surface::none,
                    {15.7, 5, 3},
                    1.5,
                    true,
                    {{{{1.71, 0.3, -1}, {1.71, 0.3, 2}, {1.71, 2, 2}, {1.71, 2, -1}}}}}),
    [](const auto& instance) { return instance.param.name; });

TEST(Pattern, DoesNotRepeatWhatIsNotAlike) {
  // A plane that is calibrated as a whole, a particle that one bond holds, one that none turns.
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
  Network frames = build_network(make_body(uncorrected), input);
  EXPECT_TRUE(can_repeat(frames));
  frames.bending[0] = 0.0;
  EXPECT_TRUE(can_repeat(frames));
  for (Index e = 0; e < frames.num_elements(); ++e) {
    if (frames.bonds.first[e] == 0) frames.bending[e] = 0.0;
  }
  EXPECT_FALSE(can_repeat(frames));
}

TEST(Pattern, SaysWhereCracksLeaveMoreThanOnePieceOrALooseParticle) {
  const LatticeInput lattice =
      input_of({"", Pattern::rectangular, Surface::none, {40, 8, 0}, std::sqrt(2.0)});
  LatticePattern pattern = make_pattern(make_body(lattice), network_input(lattice));
  std::vector<Index> by_crack;
  const auto stays_whole = [&](std::vector<Crack> cracks) {
    return cut_bonds(pattern, cracks, by_crack);
  };
  const double bonds = pattern.num_bonds();
  EXPECT_TRUE(stays_whole({{{{9, 9, 0}, {10, 9, 0}}}}));  // beside the box
  EXPECT_EQ(by_crack, std::vector<Index>{0});
  EXPECT_TRUE(stays_whole({{{{4.0, -1, 0}, {4.0, 1.2, 0}}}}));  // but for a row and a half
  EXPECT_EQ(pattern.num_bonds(), bonds - by_crack[0]);
  EXPECT_FALSE(stays_whole({{{{4.0, -1, 0}, {4.0, 2, 0}}}}));
  // Two cracks that do so together, each by itself does not.
  const Crack lower{{{4.0, -1, 0}, {4.0, 0.8, 0}}}, upper{{{4.0, 2, 0}, {4.0, 0.8, 0}}};
  EXPECT_TRUE(stays_whole({lower}));
  EXPECT_TRUE(stays_whole({upper}));
  EXPECT_FALSE(stays_whole({lower, upper}));
  // Past a corner, which keeps the bond along the face alone.
  EXPECT_FALSE(stays_whole({{{{0.2, 0.0, 0}, {0.4, 0.0, 0}}}}));
}

}  // namespace
}  // namespace perilink
