#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assembly/fields.hpp"
#include "assembly/internal_force.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using namespace test;

Csr neighbourhoods_of(const Network& network) {
  return bonds_of_particles(network.bonds, network.particles.size());
}

TEST(ParticleDamage, IsTheBrokenShareOfTheFamilyVolume) {
  const Network network = make_network({"", Pattern::rectangular, Surface::none}, 5);
  const Csr neighbourhoods = neighbourhoods_of(network);
  std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  for (const double damage : particle_damage(network, neighbourhoods, secants))
    EXPECT_EQ(damage, 0.0);
  // Break all bonds of particle 0, a corner.
  for (const Index b : neighbourhoods.row(0)) secants[b] = 0.0;
  const auto damage = particle_damage(network, neighbourhoods, secants);
  EXPECT_EQ(damage[0], 1.0);
  double volume = 0.0;
  for (const Index b : neighbourhoods.row(1)) {
    const Index j = network.bonds.first[b] == 1 ? network.bonds.second[b] : network.bonds.first[b];
    volume += network.particles.volumes[j];
  }
  EXPECT_NEAR(damage[1], network.particles.volumes[0] / volume, 1e-15);
  EXPECT_EQ(damage.back(), 0.0);
  // What has lost a part of its stiffness is damaged by that part.
  for (const Index b : neighbourhoods.row(0)) secants[b] = 0.25;
  EXPECT_DOUBLE_EQ(particle_damage(network, neighbourhoods, secants)[0], 0.75);
}

TEST(StrainEnergyDensity, SumsToTheEnergyOfTheNetwork) {
  const Network network = make_network({"", Pattern::hexagonal, Surface::none}, 5);
  const auto secants = random_secants(network.num_elements(), 1);
  const auto displacement = random_vector(network.particles.positions.size(), 2);
  const auto density = strain_energy_density(network, secants, displacement);
  const double sum =
      std::inner_product(density.begin(), density.end(), network.particles.volumes.begin(), 0.0);
  const double energy = internal_force(network, secants, displacement).energy;
  EXPECT_NEAR(sum, energy, 1e-13 * energy);
}

/// A body turned by 40 degrees after a stretch of 0.1 along the first axis.
TEST(Fields, GreenStrainsDoNotSeeRotations) {
  const double c = std::cos(0.7), s = std::sin(0.7), stretch = 1.1;
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    const Network network = make_network({"", pattern, Surface::none}, 4);
    const std::array<Vector3, 3> gradient = {
        {{stretch * c - 1.0, -s, 0.0}, {stretch * s, c - 1.0, 0.0}, {0.0, 0.0, 0.0}}};
    const auto displacement = linear_field(network.particles, gradient);
    const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
    const auto strains =
        principal_strains(network, neighbourhoods_of(network), intact, displacement, Strain::green);
    const double green = 0.5 * (stretch * stretch - 1.0);
    const auto dim = static_cast<std::size_t>(network.dim());
    for (std::size_t k = 0; k < strains.size(); ++k) {
      EXPECT_NEAR(strains[k], k % dim == 0 ? green : 0.0, 1e-12);
    }
    const std::array<Vector3, 3> straight = {{{green, 0.0, 0.0}, {}, {}}};
    const auto expected =
        strain_energy_density(network, intact, linear_field(network.particles, straight));
    const auto density = strain_energy_density(network, intact, displacement, Strain::green);
    for (std::size_t i = 0; i < density.size(); ++i) {
      EXPECT_NEAR(density[i], expected[i], 1e-12 * expected[i]);
    }
  }
}

TEST(Fields, PartTheMotionIntoDisplacementsAndRotations) {
  Network network = single_frame(2, {1.0, 0.0}, 1.0, 1.0);
  const std::vector<double> motion = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(translations(network, motion), (std::vector<double>{1, 2, 4, 5}));
  EXPECT_EQ(rotations(network, motion), (std::vector<double>{3, 6}));
  network.bending.clear();
  EXPECT_EQ(translations(network, {motion.data(), 4}), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_TRUE(rotations(network, {motion.data(), 4}).empty());
}

TEST(PrincipalStrains, OfALinearFieldAreExactWhateverBondsAreBroken) {
  const std::array<Vector3, 3> gradient = {
      {{3e-3, 4e-3, 1e-3}, {-2e-3, 1e-3, 0}, {3e-3, 2e-3, 5e-3}}};
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    const Network network = make_network({"", pattern, Surface::none}, 4);
    const int dim = network.dim();
    const auto displacement = linear_field(network.particles, gradient);
    const auto secants = random_secants(network.num_elements(), 3);
    const auto strains =
        principal_strains(network, neighbourhoods_of(network), secants, displacement);
    double trace = 0.0;
    double squares = 0.0;  // for the symmetric part
    for (int row = 0; row < dim; ++row) {
      trace += gradient[row][row];
      for (int col = 0; col < dim; ++col) {
        squares += std::pow(0.5 * (gradient[row][col] + gradient[col][row]), 2);
      }
    }
    for (Index i = 0; i < network.particles.size(); ++i) {
      const double* own = strains.data() + static_cast<std::size_t>(i) * dim;
      EXPECT_TRUE(std::is_sorted(own, own + dim, std::greater<>()));
      // The least-squares matrix of a particle with few intact bonds has a condition of 1e3.
      EXPECT_NEAR(std::accumulate(own, own + dim, 0.0), trace, 1e-14);
      EXPECT_NEAR(std::inner_product(own, own + dim, own, 0.0), squares, 1e-16);
    }
  }
}

TEST(PrincipalStrains, AreZeroWhereTheBondsDoNotSpanTheSpace) {
  const Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  const Csr neighbourhoods = neighbourhoods_of(network);
  std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
  for (const Index b : neighbourhoods.row(0)) secants[b] = 0.0;
  secants[neighbourhoods.row(0)[0]] = 1.0;
  const auto displacement = random_vector(network.particles.positions.size(), 2);
  const auto strains = principal_strains(network, neighbourhoods, secants, displacement);
  EXPECT_EQ(strains[0], 0.0);
  EXPECT_EQ(strains[1], 0.0);
  EXPECT_NE(strains[2], 0.0);
}

}  // namespace
}  // namespace perilink
