#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "material/micromodulus.hpp"

namespace perilink {
namespace {

/// All points of a square or cubic lattice of unit spacing within a radius.
std::vector<Vector3> lattice_offsets(int dim, double radius) {
  const int reach = static_cast<int>(radius);
  const int layers = dim == 3 ? reach : 0;
  std::vector<Vector3> offsets;
  for (int k = -layers; k <= layers; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const double length = std::hypot(i, j, k);
        if (length > 0.0 && length <= radius) {
          offsets.push_back({double(i), double(j), double(k)});
        }
      }
    }
  }
  return offsets;
}

// Gerstle, Sau & Silling 2005, Eq. 6 with the thickness: E = pi c t delta^3 (1 + nu) / 12, and in
// three dimensions E = pi c delta^4 / 12.
TEST(ContinuumMicromodulus, GivesBackYoungsModulus) {
  constexpr double modulus = 3604.0;
  constexpr double horizon = 7.5;
  constexpr double thickness = 10.0;
  const double cube = std::pow(horizon, 3);
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    const double c = continuum_micromodulus(problem, modulus, horizon, thickness);
    // Plane strain: the in-plane sum gives E / ((1 + nu) (1 - 2 nu)) = 8 E / 5 at nu = 1/4.
    const double expected = problem == Problem::plane_stress
                                ? std::numbers::pi * c * thickness * cube * (4.0 / 3.0) / 12.0
                                : std::numbers::pi * c * thickness * cube * 1.25 / 12.0;
    EXPECT_NEAR(expected, modulus, 1e-12 * modulus);
  }
  const double c = continuum_micromodulus(Problem::three_dimensional, modulus, horizon, thickness);
  EXPECT_NEAR(std::numbers::pi * c * cube * horizon / 12.0, modulus, 1e-12 * modulus);
}

// Poisson's ratio of square lattices at horizon levels 1 and 2, by hand: with the four nearest
// neighbours U1 = U2 (nu = 0); the diagonal ones add to U1 only: (U1 - U2) / (U1 + U2) =
// 4 sqrt2 / (8 + 4 sqrt2) = 0.41421 (the +24.3 % of the lateral strain in Table 1).
TEST(LatticeModuli, AgreesWithSumsByHand) {
  const auto nearest = lattice_moduli(Problem::plane_stress, lattice_offsets(2, 1.0), 2.0);
  EXPECT_NEAR(nearest.poissons_ratio, 0.0, 1e-15);
  // U1 = U2 = 1: c V^2 = E V, V = 2.
  EXPECT_NEAR(nearest.micromodulus_per_modulus, 0.5, 1e-15);
  const auto level2 = lattice_moduli(Problem::plane_stress, lattice_offsets(2, 1.5), 1.0);
  EXPECT_NEAR(level2.poissons_ratio, std::numbers::sqrt2 - 1.0, 1e-15);
}

TEST(LatticeModuli, ApproachesTheContinuum) {
  constexpr double horizon = 200.0;
  const auto plane = lattice_offsets(2, horizon);
  for (const Problem problem : {Problem::plane_stress, Problem::plane_strain}) {
    const auto moduli = lattice_moduli(problem, plane, 1.0);
    // Points counted by their centres: the error of Gauss's circle problem falls with the radius
    // to about the power -4/3; 4e-3 at radius 60, under 1e-3 here.
    EXPECT_NEAR(moduli.poissons_ratio, bond_poissons_ratio(problem), 1e-3);
    EXPECT_NEAR(
        moduli.micromodulus_per_modulus / continuum_micromodulus(problem, 1.0, horizon, 1.0), 1.0,
        3e-3);
  }
  const auto solid = lattice_offsets(3, 20.0);
  const auto moduli = lattice_moduli(Problem::three_dimensional, solid, 1.0);
  EXPECT_DOUBLE_EQ(moduli.poissons_ratio, 0.25);
  EXPECT_NEAR(moduli.micromodulus_per_modulus /
                  continuum_micromodulus(Problem::three_dimensional, 1.0, 20.0, 1.0),
              1.0, 1e-2);
}

// The stiffness tensor summed in full, averaged over all rotations (Voigt: K = C_iijj / 9,
// G = (3 C_ijij - C_iijj) / 30), has Young's modulus 1 and Poisson's ratio 1/4.
TEST(LatticeModuli, ThreeDimensionalIsTheVoigtMean) {
  const auto offsets = lattice_offsets(3, 2.3);
  constexpr double volume = 0.3;
  const auto moduli = lattice_moduli(Problem::three_dimensional, offsets, volume);
  double iijj = 0.0;
  double ijij = 0.0;
  for (const Vector3& xi : offsets) {
    const double length = std::hypot(xi[0], xi[1], xi[2]);
    const double weight =
        0.5 * moduli.micromodulus_per_modulus * volume * length / std::pow(length, 4);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        iijj += weight * xi[i] * xi[i] * xi[j] * xi[j];
        ijij += weight * xi[i] * xi[j] * xi[i] * xi[j];
      }
    }
  }
  const double bulk = iijj / 9.0;
  const double shear = (3.0 * ijij - iijj) / 30.0;
  EXPECT_NEAR(1.0 / (9.0 * bulk) + 1.0 / (3.0 * shear), 1.0, 1e-13);
  EXPECT_NEAR((3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)), 0.25, 1e-13);
}

TEST(LatticeModuli, RefusesAFamilyThatCannotResistShear) {
  EXPECT_THROW(lattice_moduli(Problem::plane_stress, {}, 1.0), std::invalid_argument);
  const std::vector<Vector3> diagonal = {{1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0}};
  EXPECT_THROW(lattice_moduli(Problem::plane_strain, diagonal, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
