#include "calibration/isotropic_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/lattice.hpp"

namespace perilink {
namespace {

struct Case {
  Pattern pattern;
  double ratio;
  bool bending;
  double stretch = 1.0;  // factor on the rows' distance
};

class Isotropic : public testing::TestWithParam<Case> {};

/// The moduli of the weighted family against those asked for, computed here from energies: strain
/// energy of a particle at several strains. The solver's residual is 1e-12 of the modulus.
TEST_P(Isotropic, FamilyHasTheEnergyOfTheContinuum) {
  const auto [pattern, ratio, bending, stretch] = GetParam();
  Lattice lattice;
  lattice.pattern = pattern;
  lattice.dim = pattern == Pattern::rectangular || pattern == Pattern::hexagonal ? 2 : 3;
  lattice.spacing = 0.5;
  lattice.step = {0.5, stretch * (pattern == Pattern::hexagonal ? 0.5 * std::sqrt(0.75) : 0.5),
                  0.5};
  lattice.cell_volume = 0.1;
  const auto neighbourhood = interior_neighbourhood(lattice, ratio * 0.5);
  const LameConstants constants{2.0, bending ? 3.5 : 2.0};
  NeighbourhoodStiffness stiffness;
  for (const Vector3& x : neighbourhood.offsets) {
    const double length = std::hypot(x[0], x[1], x[2]);
    stiffness.axial.push_back(partial_volume(length, ratio * 0.5, 0.5) / length);
    if (bending) stiffness.bending.push_back(0.3 / (length * length * length));
  }
  make_isotropic(lattice.dim, neighbourhood.offsets, lattice.cell_volume, constants, stiffness);
  const double strains[4][6] = {
      {1, 0, 0, 0, 0, 0}, {1, 1, 1, 0, 0, 0}, {1, -1, 0, .3, 0, 0}, {0, .2, -.5, 1, .7, -.4}};
  for (const auto& e : strains) {
    double eps[3][3] = {{e[0], e[3], e[5]}, {e[3], e[1], e[4]}, {e[5], e[4], e[2]}};
    if (lattice.dim == 2) eps[2][2] = eps[1][2] = eps[2][1] = eps[0][2] = eps[2][0] = 0.0;
    double energy = 0.0, trace = 0.0, square = 0.0;
    for (std::size_t k = 0; k < neighbourhood.offsets.size(); ++k) {
      EXPECT_GT(stiffness.axial[k], 0.0);
      const Vector3& x = neighbourhood.offsets[k];
      Vector3 u{};
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) u[a] += eps[a][b] * x[b];
      }
      const double length = std::hypot(x[0], x[1], x[2]);
      const double axial = (u[0] * x[0] + u[1] * x[1] + u[2] * x[2]) / length;
      const double shear = u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - axial * axial;
      energy += 0.25 * stiffness.axial[k] * axial * axial;
      if (bending) energy += 0.25 * stiffness.bending[k] * shear;
    }
    for (int a = 0; a < 3; ++a) {
      trace += eps[a][a];
      for (int b = 0; b < 3; ++b) square += eps[a][b] * eps[a][b];
    }
    const double expected =
        lattice.cell_volume * (0.5 * constants.lambda * trace * trace + constants.mu * square);
    EXPECT_NEAR(energy, expected, 1e-11 * constants.mu);
  }
  // No couple on the particle in any strain: sum k_b (x x - |x|^2 / dim).
  double couple[3][3] = {}, trace = 0.0;
  for (std::size_t k = 0; bending && k < neighbourhood.offsets.size(); ++k) {
    const Vector3& x = neighbourhood.offsets[k];
    for (int a = 0; a < lattice.dim; ++a) {
      for (int b = 0; b < lattice.dim; ++b) couple[a][b] += stiffness.bending[k] * x[a] * x[b];
      trace += stiffness.bending[k] * x[a] * x[a];
    }
  }
  for (int a = 0; a < lattice.dim; ++a) {
    for (int b = 0; b < lattice.dim; ++b) {
      EXPECT_NEAR(couple[a][b], a == b ? trace / lattice.dim : 0.0, 1e-11 * constants.mu);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Neighbourhoods, Isotropic,
    testing::Values(Case{Pattern::rectangular, 2.0, false}, Case{Pattern::rectangular, 3.0, false},
                    Case{Pattern::rectangular, 4.0, false}, Case{Pattern::hexagonal, 1.0, false},
                    Case{Pattern::hexagonal, 3.0, false}, Case{Pattern::cubic, 2.0, false},
                    Case{Pattern::cubic, 3.0, false}, Case{Pattern::rectangular, 3.0, true},
                    Case{Pattern::hexagonal, 2.0, true}, Case{Pattern::cubic, 2.0, true},
                    Case{Pattern::hexagonal, 2.0, true, 1.04},
                    Case{Pattern::cubic, 2.0, true, 0.97},
                    Case{Pattern::rectangular, std::sqrt(2.0), false}));

TEST(IsotropicWeights, RefusesAFamilyThatCannotShear) {
  const std::vector<Vector3> offsets = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  NeighbourhoodStiffness stiffness{{1, 1, 1, 1}, {}};
  EXPECT_THROW(make_isotropic(2, offsets, 1.0, {1.0, 1.0}, stiffness), std::invalid_argument);
}

TEST(PartialVolume, FallsAcrossTheHorizon) {
  EXPECT_DOUBLE_EQ(partial_volume(2.0, 3.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(partial_volume(3.0, 3.0, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(partial_volume(3.5, 3.0, 1.0), 0.0);
}

}  // namespace
}  // namespace perilink
