#include "assembly/results/bond_strain.hpp"

#include <gtest/gtest.h>

#include "discretization/bonds.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using test::LatticeCase;

constexpr std::array<Vector3, 3> gradient = {
    {{0.03, 0.01, -0.02}, {0.02, -0.04, 0.05}, {-0.01, 0.06, 0.07}}};

/// The symmetric part of the gradient in so many dimensions.
SymmetricTensor exact_strain(int dim) {
  SymmetricTensor strain{};
  for (int a = 0; a < dim; ++a) strain[a] = gradient[a][a];
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if (a < dim && b < dim) strain[3 + a] = 0.5 * (gradient[a][b] + gradient[b][a]);
  }
  return strain;
}

void expect_strains(const Network& network, double secant) {
  const std::vector<double> motion = test::linear_motion(network, gradient);
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  const std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), secant);
  const SymmetricTensor exact = exact_strain(network.dim());
  for (Index i = 0; i < network.particles.size(); ++i) {
    const SymmetricTensor strain = bond_strain(network, neighbourhoods, secants, motion, i);
    for (std::size_t c = 0; c < strain.size(); ++c) {
      // Round-off, times the condition of the families at corners, near 1e2.
      EXPECT_NEAR(strain[c], secant * exact[c], 1e-14) << "particle " << i;
    }
  }
}

class BondStrainOfUniformFields : public testing::TestWithParam<LatticeCase> {};

TEST_P(BondStrainOfUniformFields, IsThatOfTheFieldUpToTheCorners) {
  expect_strains(test::make_network(GetParam(), 4), 1.0);
  expect_strains(test::make_micropolar_network(GetParam(), 4), 1.0);
}

TEST_P(BondStrainOfUniformFields, FallsWithTheSecants) {
  expect_strains(test::make_network(GetParam(), 4), 0.3);
  expect_strains(test::make_micropolar_network(GetParam(), 4), 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, BondStrainOfUniformFields,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"calibrated", Pattern::rectangular, Surface::calibrated},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

/// Where all bonds of a particle across a line are broken, what is left pulls along it only: the
/// force of the whole on a part is what passes through the line.
TEST(BondStrain, BrokenBondsCarryNothing) {
  const Network network = test::make_network({"", Pattern::rectangular, Surface::none}, 4);
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  const std::vector<double> motion = test::linear_motion(network, gradient);
  std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  const Index middle = 12;
  for (const Index e : neighbourhoods.row(middle)) secants[e] = 0.0;
  EXPECT_EQ(bond_strain(network, neighbourhoods, secants, motion, middle), SymmetricTensor{});
  EXPECT_NE(bond_strain(network, neighbourhoods, secants, motion, middle + 1), SymmetricTensor{});
}

/// Two particles settle one strain of three.
TEST(BondStrain, IsZeroWhereTheBondsDoNotResistEveryStrain) {
  const Network network = test::single_frame(2, {1.0, 0.0}, 5.0, 0.0);
  const Csr neighbourhoods = bonds_of_particles(network.bonds, 2);
  const std::vector<double> secants = {1.0}, motion = {0.0, 0.0, 0.0, 0.1, 0.0, 0.0};
  EXPECT_EQ(bond_strain(network, neighbourhoods, secants, motion, 0), SymmetricTensor{});
}

}  // namespace
}  // namespace perilink
