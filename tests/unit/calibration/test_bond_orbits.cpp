#include "calibration/bond_orbits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibration/calibration.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/calibration_problem.hpp"

namespace perilink {
namespace {

LatticeInput orbit_box(Pattern pattern, Vector3 size) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = pattern == Pattern::face_centred ? std::sqrt(2.0) : 1.0;  // steps of one
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, size}};
  input.material = {0};
  return input;
}

struct Bonded {
  Body body;
  Bonds bonds;
  BondOrbits orbits;
};

Bonded make_bonded(Pattern pattern, Vector3 size, double horizon) {
  Bonded result;
  result.body = make_body(orbit_box(pattern, size));
  result.bonds = make_bonds(result.body.particles, horizon);
  const std::vector<std::uint8_t> free(static_cast<std::size_t>(result.bonds.size()), 1);
  result.orbits = find_orbits(*lattice_box(result.body), result.body.particles, result.bonds, free);
  return result;
}

TEST(LatticeBox, IsFoundWhereALatticeInSpaceFillsIt) {
  const auto found = lattice_box(make_body(orbit_box(Pattern::cubic, {4, 5, 6})));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->count, (std::array<Index, 3>{4, 5, 6}));
  EXPECT_TRUE(lattice_box(make_body(orbit_box(Pattern::face_centred, {4, 4, 6}))));
}

TEST(LatticeBox, IsNotFoundInOtherBodies) {
  LatticeInput corner = orbit_box(Pattern::cubic, {6, 3, 4});
  corner.solid.push_back({{0, 0, 0}, {3, 6, 4}});
  corner.material.push_back(0);
  EXPECT_FALSE(lattice_box(make_body(corner)));
  for (const Vector3 plane : {Vector3{4, 4, 0}, Vector3{40, 2, 0}}) {
    EXPECT_FALSE(lattice_box(make_body(orbit_box(Pattern::rectangular, plane))));
  }
  LatticeInput bent = orbit_box(Pattern::rectangular, {6, 1, 0});
  bent.solid.push_back({{0, 1, 0}, {1, 2, 0}});
  bent.material.push_back(0);
  EXPECT_FALSE(lattice_box(make_body(bent)));
  // A hole of one cell.
  LatticeInput hole = orbit_box(Pattern::cubic, {5, 5, 2});
  hole.solid.push_back({{0, 0, 2}, {5, 2, 3}});
  hole.solid.push_back({{0, 3, 2}, {5, 5, 3}});
  hole.solid.push_back({{0, 2, 2}, {2, 3, 3}});
  hole.solid.push_back({{3, 2, 2}, {5, 3, 3}});
  hole.solid.push_back({{0, 0, 3}, {5, 5, 5}});
  hole.material.assign(hole.solid.size(), 0);
  EXPECT_FALSE(lattice_box(make_body(hole)));
}

TEST(LatticeBox, IsFoundInStripsOfOneRowOfCells) {
  const auto lying = lattice_box(make_body(orbit_box(Pattern::rectangular, {30, 1, 0})));
  ASSERT_TRUE(lying);
  EXPECT_EQ(lying->count, (std::array<Index, 3>{30, 1, 0}));
  LatticeInput standing = orbit_box(Pattern::rectangular, {1, 30, 0});
  standing.thickness = 7.0;
  ASSERT_TRUE(lattice_box(make_body(standing)));
  // Bonds lie alike whatever the length: mirrored in both middle lines, depths 0 to 9 are places.
  for (const double length : {40.0, 400.0}) {
    const Bonded strip = make_bonded(Pattern::rectangular, {length, 1, 0}, 3.1);
    EXPECT_EQ(strip.orbits.representatives.size(), 10u);
  }
}

using Point = std::array<long, 3>;

/// Every symmetry of the cube maps every bond on one with the same views.
class EveryPattern : public testing::TestWithParam<Pattern> {};

TEST_P(EveryPattern, MirroredAndTurnedBondsLieAlike) {
  constexpr long side = 4;
  const Bonded cube = make_bonded(GetParam(), {side, side, side}, 2.0);
  const Particles& particles = cube.body.particles;
  std::map<Point, Index> at;
  std::vector<Point> points;
  for (Index i = 0; i < particles.size(); ++i) {
    Point point{};
    for (int a = 0; a < 3; ++a) point[a] = std::lround(particles.position(i)[a]);
    points.push_back(point);
    at[point] = i;
  }
  std::map<std::pair<Index, Index>, Index> between;
  for (Index b = 0; b < cube.bonds.size(); ++b) {
    between[{cube.bonds.first[b], cube.bonds.second[b]}] = b;
  }
  const auto image = [&](Index i, const std::array<int, 3>& order, int mirrors) {
    Point point{};
    for (int a = 0; a < 3; ++a) {
      const long x = points[i][order[a]];
      point[a] = (mirrors >> a & 1) != 0 ? side - x : x;
    }
    return at.at(point);
  };
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int mirrors = 0; mirrors < 8; ++mirrors) {
      for (Index b = 0; b < cube.bonds.size(); ++b) {
        const Index i = image(cube.bonds.first[b], order, mirrors);
        const Index j = image(cube.bonds.second[b], order, mirrors);
        const auto& views = cube.orbits.views[between.at(std::minmax(i, j))];
        EXPECT_EQ(views[i < j ? 0 : 1], cube.orbits.views[b][0]);
        EXPECT_EQ(views[i < j ? 1 : 0], cube.orbits.views[b][1]);
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Particles that no symmetry maps on each other are all represented: of a cube of four steps
/// those with depths 0 <= a <= b <= c <= 2, of a face-centred one those with an even sum.
TEST_P(EveryPattern, EachKindOfPlaceHasOneRepresentative) {
  const Bonded cube = make_bonded(GetParam(), {4, 4, 4}, 2.0);
  EXPECT_EQ(cube.orbits.representatives.size(), GetParam() == Pattern::cubic ? 10 : 6);
  const Bonded brick = make_bonded(GetParam(), {4, 6, 8}, 2.0);
  EXPECT_EQ(brick.orbits.representatives.size(), GetParam() == Pattern::cubic ? 3 * 4 * 5 : 30);
}

TEST_P(EveryPattern, LongBoxesAreAllAlike) {
  const Bonded orbit_box = make_bonded(GetParam(), {14, 14, 14}, 2.0);
  for (const Vector3 size : {Vector3{16, 16, 16}, Vector3{14, 18, 16}}) {
    const Bonded longer = make_bonded(GetParam(), size, 2.0);
    EXPECT_EQ(longer.orbits.representatives.size(), orbit_box.orbits.representatives.size());
    EXPECT_EQ(longer.orbits.num_views, orbit_box.orbits.num_views);
  }
}

/// A stiffness that depends on the class alone comes back from the sample to every bond, with the
/// inflection at the right end.
TEST_P(EveryPattern, TheSampleSpreadsToTheWholeBox) {
  const Bonded brick = make_bonded(GetParam(), {14, 14, 6}, 2.0);
  const BondOrbits& orbits = brick.orbits;
  BondStiffness wanted;
  for (Index b = 0; b < brick.bonds.size(); ++b) {
    const auto [here, there] = orbits.views[b];
    wanted.axial.push_back(1.0 + orbits.of_bond(b));
    wanted.bending.push_back(0.5 + orbits.of_bond(b));
    wanted.inflection.push_back(here < there ? 0.3 : here > there ? 0.7 : 0.5);
  }
  const std::vector<std::uint8_t> free(static_cast<std::size_t>(brick.bonds.size()), 1);
  const OrbitSample sample =
      sample_orbits(orbits, brick.body.particles.size(), brick.bonds, free, wanted);
  const std::set<Index> represents(orbits.representatives.begin(), orbits.representatives.end());
  EXPECT_LT(sample.bonds.size(), brick.bonds.size() / 2);
  for (Index s = 0; s < sample.bonds.size(); ++s) {
    EXPECT_TRUE(represents.count(sample.bonds.first[s]) ||
                represents.count(sample.bonds.second[s]));
  }
  BondStiffness found = wanted;
  for (double& k : found.axial) k = 0.0;
  for (double& k : found.bending) k = 0.0;
  for (double& part : found.inflection) part = 0.0;
  EXPECT_TRUE(spread(sample, sample.stiffness, orbits, found));
  EXPECT_EQ(found.axial, wanted.axial);
  EXPECT_EQ(found.bending, wanted.bending);
  for (std::size_t b = 0; b < wanted.inflection.size(); ++b) {
    EXPECT_NEAR(found.inflection[b], wanted.inflection[b], 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(BondOrbits, EveryPattern,
                         testing::Values(Pattern::cubic, Pattern::face_centred));

/// Only what is free gets a class; what is out of reach of the keys none at all.
TEST(BondOrbits, LeavesOtherBondsOut) {
  const Body body = make_body(orbit_box(Pattern::cubic, {6, 6, 6}));
  const Bonds bonds = make_bonds(body.particles, 2.0);
  std::vector<std::uint8_t> free(static_cast<std::size_t>(bonds.size()), 0);
  free[0] = 1;
  const BondOrbits orbits = find_orbits(*lattice_box(body), body.particles, bonds, free);
  EXPECT_EQ(orbits.representatives.size(), 2);
  EXPECT_NE(orbits.views[0][0], no_index);
  EXPECT_EQ(orbits.views[1][0], no_index);
  const Body rod = make_body(orbit_box(Pattern::cubic, {1, 1, 30}));
  const Bonds far = make_bonds(rod.particles, 21.0);
  free.assign(static_cast<std::size_t>(far.size()), 1);
  EXPECT_TRUE(find_orbits(*lattice_box(rod), rod.particles, far, free).representatives.empty());
}

/// Symmetry leaves few equations at each place there, and bounds leave little room: rods and walls
/// were lost where equations that repeat others did not count, and in round-off.
TEST(BondOrbits, BalanceRodsAndWallsOfOneCell) {
  struct Slender {
    Vector3 size;
    double ratio;
    bool bending;
  };
  for (const Slender& given : {Slender{{1, 30, 1}, 3.0, false}, Slender{{24, 24, 1}, 2.0, false},
                               Slender{{24, 24, 1}, 2.0, true}}) {
    test::Problem body = test::make_problem(test::box(Pattern::cubic, 1.0, given.size), given.ratio,
                                            0.0, given.bending);
    const LameConstants constants = given.bending ? LameConstants{0.8, 1.3} : LameConstants{1, 1};
    CalibrationInput input{body.body.particles,
                           body.bonds,
                           {constants},
                           std::vector<std::uint8_t>(body.bonds.size(), 1)};
    input.box = lattice_box(body.body);
    input.only_alike = true;
    const CalibrationReport report = calibrate_bonds(input, {}, body.body.facets, body.stiffness);
    EXPECT_TRUE(report.alike);
    EXPECT_LT(report.residual_after, 1e-10);
    EXPECT_LT(report.moment_after, 1e-10);
    EXPECT_EQ(report.unmet, 0);
  }
}

}  // namespace
}  // namespace perilink
