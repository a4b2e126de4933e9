#include "discretization/cuts/cracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

Particles grid(int dim) {
  LatticeInput input;
  input.pattern = dim == 2 ? Pattern::rectangular : Pattern::cubic;
  input.spacing = 1.0;
  input.solid = {{{-3, -3, -3}, {3, 3, 3}}};
  input.material = {0};
  return make_body(input).particles;
}

bool is_cut(const Particles& particles, const Bonds& bonds, const CutBonds& cut,
            const Vector3& from, const Vector3& to) {
  for (Index b = 0; b < bonds.size(); ++b) {
    const auto x = particles.position(bonds.first[b]), y = particles.position(bonds.second[b]);
    bool forth = true, back = true;
    for (int axis = 0; axis < particles.dim; ++axis) {
      forth = forth && x[axis] == from[axis] && y[axis] == to[axis];
      back = back && x[axis] == to[axis] && y[axis] == from[axis];
    }
    if (forth || back) return cut.keep[b] == 0;
  }
  ADD_FAILURE() << "no such bond";
  return false;
}

TEST(Cracks, BetweenRowsCutWhatCrossesThem) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.5);
  const std::vector<Crack> cracks = {{{{-4, 0.5, 0}, {0.25, 0.5, 0}}}};
  const CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  // Columns -3 to 0 straight up; diagonals cross at -2.5 to -0.5.
  EXPECT_EQ(cut.count[0], 4 + 2 * 3);
  EXPECT_TRUE(is_cut(particles, bonds, cut, {0, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {1, 0, 0}, {1, 1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, {1, 1, 0}));
}

TEST(Cracks, AlongARowPutItOnTheirLeft) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.0);
  const std::vector<Crack> to_right = {{{{-4, 0, 0}, {0.5, 0, 0}}}};
  CutBonds cut = find_cut_bonds(particles, bonds, to_right, 1.0);
  EXPECT_EQ(cut.count[0], 4);
  EXPECT_TRUE(is_cut(particles, bonds, cut, {-1, 0, 0}, {-1, -1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {-1, 0, 0}, {-1, 1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {-1, 0, 0}, {0, 0, 0})) << "along the crack";
  const std::vector<Crack> to_left = {{{{0.5, 0, 0}, {-4, 0, 0}}}};
  cut = find_cut_bonds(particles, bonds, to_left, 1.0);
  EXPECT_EQ(cut.count[0], 4);
  EXPECT_TRUE(is_cut(particles, bonds, cut, {-1, 0, 0}, {-1, 1, 0}));
}

TEST(Cracks, RoundOffDoesNotMatter) {
  Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.5);
  const std::vector<Crack> cracks = {{{{-4, 0, 0}, {0.5, 0, 0}}}};
  const CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-1e-8, 1e-8);
  for (double& x : particles.positions) x += shift(random);
  EXPECT_EQ(find_cut_bonds(particles, bonds, cracks, 1.0).keep, cut.keep);
}

TEST(Cracks, AParticleAtTheTipStaysBondedToWhatLiesAhead) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.5);
  const std::vector<Crack> cracks = {{{{-4, 0, 0}, {0, 0, 0}}}};
  const CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  EXPECT_TRUE(is_cut(particles, bonds, cut, {0, 0, 0}, {-1, -1, 0}));
  EXPECT_TRUE(is_cut(particles, bonds, cut, {0, 0, 0}, {0, -1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, {1, -1, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, {0, 1, 0}));
}

/// Both ways round a kink at a particle: the particle belongs to the left, so it loses its bonds to
/// the right and none to the left.
TEST(Cracks, AParticleAtAKinkBelongsToOneSideOnly) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.5);
  std::vector<Crack> cracks = {{{{-4, 0, 0}, {0, 0, 0}, {0, -4, 0}}}};  // turns right
  CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  EXPECT_TRUE(is_cut(particles, bonds, cut, {0, 0, 0}, {-1, -1, 0}));
  for (const Vector3 left : {Vector3{-1, 1, 0}, Vector3{0, 1, 0}, Vector3{1, 1, 0},
                             Vector3{1, 0, 0}, Vector3{1, -1, 0}}) {
    EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, left)) << left[0] << " " << left[1];
  }
  std::reverse(cracks[0].points.begin(), cracks[0].points.end());  // turns left
  cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  EXPECT_FALSE(is_cut(particles, bonds, cut, {0, 0, 0}, {-1, -1, 0}));
  for (const Vector3 right : {Vector3{-1, 1, 0}, Vector3{0, 1, 0}, Vector3{1, 1, 0},
                              Vector3{1, 0, 0}, Vector3{1, -1, 0}}) {
    EXPECT_TRUE(is_cut(particles, bonds, cut, {0, 0, 0}, right)) << right[0] << " " << right[1];
  }
}

/// In any order and direction lines that share ends are one line with a direction, that of the
/// first; a line there and back is one, too.
TEST(Cracks, ThatShareEndsRunOnFromTheFirst) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 2.5);
  const std::vector<Crack> line = {{{{-2, 0, 0}, {2, 0, 0}}}};
  const auto expected = find_cut_bonds(particles, bonds, line, 1.0).keep;
  for (const std::vector<Crack>& pieces : std::vector<std::vector<Crack>>{
           {{{{0, 0, 0}, {2, 0, 0}}}, {{{0, 0, 0}, {-2, 0, 0}}}},
           {{{{-2, 0, 0}, {0, 0, 0}}}, {{{2, 0, 0}, {0, 0, 0}}}},
           {{{{-2, 0, 0}, {-1, 0, 0}}}, {{{2, 0, 0}, {1, 0, 0}}}, {{{1, 0, 0}, {-1, 0, 0}}}},
           {{{{-2, 0, 0}, {2, 0, 0}, {-2, 0, 0}}}}}) {
    EXPECT_EQ(find_cut_bonds(particles, bonds, pieces, 1.0).keep, expected);
  }
}

/// The particle in the middle of four lines lies in one of the four sectors.
TEST(Cracks, AStarLeavesItsMiddleOnOneSide) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.5);
  const Vector3 middle{0, 0, 0};
  const std::vector<Crack> star = {
      {{middle, {2, 0, 0}}}, {{middle, {0, 2, 0}}}, {{middle, {-2, 0, 0}}}, {{middle, {0, -2, 0}}}};
  const CutBonds cut = find_cut_bonds(particles, bonds, star, 1.0);
  int left = 0;
  for (const Vector3& to :
       {Vector3{1, 1, 0}, Vector3{-1, 1, 0}, Vector3{-1, -1, 0}, Vector3{1, -1, 0}}) {
    left += !is_cut(particles, bonds, cut, middle, to);
  }
  EXPECT_EQ(left, 1);
}

TEST(Cracks, PlanesCutInSpace) {
  const Particles particles = grid(3);
  const Bonds bonds = make_bonds(particles, 1.0);
  // Rows between, then along a layer; seen from above the corners run counter-clockwise.
  for (const double z : {0.5, 0.0}) {
    const std::vector<Crack> cracks = {{{{-4, -4, z}, {0.5, -4, z}, {0.5, 4, z}, {-4, 4, z}}}};
    const CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
    EXPECT_EQ(cut.count[0], 4 * 7);
    EXPECT_TRUE(is_cut(particles, bonds, cut, {-1, 2, 0}, {-1, 2, z > 0.0 ? 1.0 : -1.0}));
    EXPECT_FALSE(is_cut(particles, bonds, cut, {-1, 2, 0}, {-1, 2, z > 0.0 ? -1.0 : 1.0}));
    EXPECT_FALSE(is_cut(particles, bonds, cut, {1, 2, 0}, {1, 2, 1}));
  }
}

TEST(Cracks, ABondAcrossTwoCracksCountsForBothAndOnceForEach) {
  const Particles particles = grid(2);
  const Bonds bonds = make_bonds(particles, 1.0);
  const std::vector<Crack> cracks = {{{{-0.5, 0.4, 0}, {0, 0.5, 0}, {0.5, 0.4, 0}}},
                                     {{{-0.5, 0.6, 0}, {0.5, 0.6, 0}}}};
  const CutBonds cut = find_cut_bonds(particles, bonds, cracks, 1.0);
  EXPECT_EQ(cut.count, (std::vector<Index>{1, 1}));
  EXPECT_EQ(std::count(cut.keep.begin(), cut.keep.end(), 0), 1);
}

TEST(Cracks, RefuseWhatIsNoCrack) {
  EXPECT_THROW(check_crack({{{0, 0, 0}, {0, 0, 0}}}, 2), std::invalid_argument);
  EXPECT_THROW(check_crack({{{0, 0, 0}}}, 2), std::invalid_argument);
  EXPECT_THROW(check_crack({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, 3), std::invalid_argument);
  EXPECT_THROW(check_crack({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}}, 3),
               std::invalid_argument);
  EXPECT_THROW(check_crack({{{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}}, 3),
               std::invalid_argument);
  EXPECT_NO_THROW(check_crack({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 3));
}

}  // namespace
}  // namespace perilink
