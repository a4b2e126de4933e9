#include "material/strength/face_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "material/softening.hpp"

namespace perilink {
namespace {

constexpr double round_off = 1e-12;
constexpr std::array<double, 2> even = {1.0, 1.0};

/// A square lattice of spacing one whose nearest neighbours have the stiffness 2 and the diagonal
/// ones 1, with a thickness of one.
const std::vector<Vector3> offsets = {{1, 0, 0}, {-1, 0, 0},  {0, 1, 0},  {0, -1, 0},
                                      {1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
const std::vector<double> stiffness = {2, 2, 2, 2, 1, 1, 1, 1};

std::vector<LayerBond> square(const Vector3& normal) {
  return layer_bonds(offsets, stiffness, {}, 1.0, normal).value();
}

BondLaw linear_law(double end) {
  const SofteningShape shape{Softening::linear};
  return saw_tooth_of(SofteningCurve(shape, softening_energy(shape, end)), 0.005);
}

TEST(LayerBonds, TakeThoseTogetherThatAreAlike) {
  const std::vector<LayerBond> bonds = square({1.0, 0.0, 0.0});
  ASSERT_EQ(bonds.size(), 3u);
  double weight = 0.0;
  for (const LayerBond& bond : bonds) {
    EXPECT_EQ(bond.layers, 1);
    weight += bond.weight;
  }
  // Half of sum k xi^2 over all neighbours.
  EXPECT_NEAR(weight, 0.5 * (4 * 2.0 + 4 * 2.0), round_off);
}

TEST(LayerBonds, CountLayersFromTheNearestOne) {
  int most = 0;
  for (const LayerBond& bond : square({std::sqrt(0.5), std::sqrt(0.5), 0.0})) {
    most = std::max(most, bond.layers);
  }
  EXPECT_EQ(most, 2);  // the diagonal, twice as high as the sides of the square
}

TEST(LayerBonds, AreNoneWhereTheLatticeHasNoLayers) {
  EXPECT_FALSE(layer_bonds(offsets, stiffness, {}, 1.0, {std::cos(0.3), std::sin(0.3), 0.0}));
}

/// Every bond crosses the face once, and layers are adjacent: the whole body stretches uniformly.
/// Bonds along x break first, and inclined bonds carry less.
TEST(FaceStrength, OfBrittleBondsIsTheStressAtTheirStretch) {
  // sum of k xi^2 / V: 2 along x, 2 along y, 2 and 2 along the diagonals; without stress across.
  const double normal = 2.0 + 4.0 * 0.25, both = 4.0 * 0.25;
  const double modulus = normal - both * both / normal;
  EXPECT_NEAR(face_strength(square({1.0, 0.0, 0.0}), even, BondLaw::brittle()), modulus,
              1e-9 * modulus);
}

/// A bond that takes very much energy is on its plateau when all others are: with the strains held
/// across by bonds that do not soften, each carries no more than its largest force.
TEST(FaceStrength, OfToughBondsComesNearTheSumOfTheirLargestForces) {
  const double most = 2.0 + 4.0 * 0.5;  // sum of k xi^2 cos^2 / V
  const double tough = face_strength(square({1.0, 0.0, 0.0}), even, linear_law(5000.0));
  EXPECT_LT(tough, 1.01 * most);  // the segments
  EXPECT_GT(tough, 0.95 * most);
  EXPECT_LT(face_strength(square({1.0, 0.0, 0.0}), even, linear_law(5.0)), tough);
}

/// Bonds along the normal that only join neighbouring layers carry the load of one bond, for any
/// material on either side.
TEST(FaceStrength, OfOneKindOfBondsIsTheLargestForceOfOne) {
  const std::vector<LayerBond> chain = {{1, 1.0, 3.0, 0.0}, {1, 0.0, 1.0, 0.0}};
  for (const auto& sides : {even, {0.5, 1.5}}) {
    EXPECT_NEAR(face_strength(chain, sides, BondLaw::brittle()), 3.0, 1e-9);
  }
}

/// Uniform strain is the state of equilibrium of bonds of any length until the first one breaks.
TEST(FaceStrength, BeginsFromAUniformStrain) {
  const std::vector<LayerBond> chain = {{1, 1.0, 3.0, 0.0}, {3, 1.0, 2.0, 0.0}, {1, 0.0, 1.0, 0.0}};
  EXPECT_NEAR(face_strength(chain, even, BondLaw::brittle()), 5.0, 1e-9);
}

}  // namespace
}  // namespace perilink
