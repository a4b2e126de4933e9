#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "discretization/lattices/make_body.hpp"
#include "material/critical_stretch.hpp"
#include "material/micromodulus.hpp"
#include "network/builder/network_builder.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// A rectangular body whose right half is a second, stiffer and tougher material.
LatticeInput two_materials(Surface surface) {
  LatticeInput input = body_input({"", Pattern::rectangular, surface}, 8);
  Box right = input.solid[0];
  right.lower[0] = 0.5 * right.upper[0];
  input.solid.push_back(right);
  input.material = {0, 1};
  return input;
}

/// Particles in the joint break as the material that a bond enters there.
TEST(BuildNetwork, BondsCarryTheMeanOfTheirEndsAndBreakByTheSmallerEnergy) {
  const LatticeInput body_of = two_materials(Surface::none);
  const Body body = make_body(body_of);
  NetworkInput input = network_input(body_of);
  input.micromodulus = Constants::continuum;
  input.critical_stretch = Constants::continuum;
  input.materials = {{30.0, 0.02}, {90.0, 0.06}};
  const Network network = build_network(body, input);
  const double c = continuum_micromodulus(input.problem, 30.0, input.horizon, input.thickness);
  std::set<double> factors;
  for (Index b = 0; b < network.num_elements(); ++b) {
    const Index i = network.bonds.first[b];
    const Index j = network.bonds.second[b];
    const double mean = 1.0 + body.particles.material[i] + body.particles.material[j];
    EXPECT_NEAR(
        network.stiffness[b],
        mean * c * body.particles.volumes[i] * body.particles.volumes[j] / network.bonds.lengths[b],
        1e-12 * network.stiffness[b]);
    const auto [first, second] = network.materials_of.at(b);
    const double energy = input.materials[std::min(first, second)].fracture_energy;
    const double modulus = (1.0 + first + second) * c;
    EXPECT_NEAR(
        network.critical_stretch[b],
        continuum_critical_stretch(input.problem, energy, modulus, input.horizon, input.thickness),
        1e-12 * network.critical_stretch[b]);
    factors.insert(mean);
  }
  EXPECT_EQ(factors.size(), 3U);
  EXPECT_EQ(network.first_slip_spring, network.num_elements());
  EXPECT_EQ(network.first_bar_element, network.num_elements());
}

TEST(BuildNetwork, AnUnbreakableEndMakesAnUnbreakableBond) {
  const LatticeInput body_of = two_materials(Surface::none);
  NetworkInput input = network_input(body_of);
  input.materials = {{30.0, 0.02}, {30.0, infinity}};
  const Network network = build_network(make_body(body_of), input);
  for (Index b = 0; b < network.num_elements(); ++b) {
    const bool tough = network.particles.material[network.bonds.first[b]] == 1 ||
                       network.particles.material[network.bonds.second[b]] == 1;
    EXPECT_EQ(std::isinf(network.critical_stretch[b]), tough);
  }
}

TEST(BuildNetwork, BondsToGhostsHaveHalfTheStiffnessAndTheSolidsCriticalStretch) {
  const LatticeInput body_of = body_input({"", Pattern::hexagonal, Surface::ghost}, 6);
  const Body body = make_body(body_of);
  const NetworkInput input = network_input(body_of);
  const Network network = build_network(body, input);
  const double c = moduli_of(body, input, input.materials[0]).micromodulus;
  const double square = std::pow(body.lattice.cell_volume, 2);
  int ghosts = 0;
  for (Index b = 0; b < network.num_elements(); ++b) {
    const bool ghost = network.particles.kind[network.bonds.second[b]] == ParticleKind::ghost;
    ghosts += ghost;
    EXPECT_NEAR(network.stiffness[b], (ghost ? 0.5 : 1.0) * c * square / network.bonds.lengths[b],
                1e-12 * network.stiffness[b]);
    EXPECT_EQ(network.critical_stretch[b], network.critical_stretch[0]);
  }
  EXPECT_GT(ghosts, 0);
  EXPECT_TRUE(find_loose_particles(network).empty());
}

TEST(BuildNetwork, LatticeConstantsReleaseTheFractureEnergy) {
  const LatticeInput body_of = body_input({"", Pattern::hexagonal, Surface::none}, 6);
  const Body body = make_body(body_of);
  const NetworkInput input = network_input(body_of);
  const Network network = build_network(body, input);
  const double c = moduli_of(body, input, input.materials[0]).micromodulus;
  const double sum = lattice_fracture_sum(
      input.problem, interior_neighbourhood(body.lattice, input.horizon).offsets,
      body.lattice.cell_volume, c);
  EXPECT_NEAR(0.5 * sum * std::pow(network.critical_stretch[0], 2), 0.02, 1e-15);
}

TEST(BuildNetwork, BarsAddSegmentsAndTies) {
  const LatticeInput body_of = body_input({"", Pattern::rectangular, Surface::none}, 8);
  const Body body = make_body(body_of);
  NetworkInput input = network_input(body_of);
  // One bar between the rows, one a hundredth of a spacing off a row.
  input.bars = {{{0.1, 0.5, 0.0}, {1.5, 0.5, 0.0}}, {{0.0, 1.002, 0.0}, {1.6, 1.002, 0.0}}};
  input.bar_materials = {{200.0, 0.01, 0.4, true}, {210.0, 0.02, infinity, false}};
  const Network network = build_network(body, input);
  const double c = moduli_of(body, input, input.materials[0]).micromodulus;

  ASSERT_EQ(network.num_elements() - network.first_bar_element, 7 + 8);
  EXPECT_DOUBLE_EQ(network.critical_stretch[network.first_bar_element], 0.4 / 200.0);
  EXPECT_TRUE(network.law(network.first_bar_element).endless());
  EXPECT_TRUE(network.law(network.first_slip_spring).is_brittle());
  EXPECT_EQ(network.critical_stretch.back(), infinity);
  EXPECT_NEAR(network.stiffness[network.first_bar_element], 200.0 * 0.01 / 0.2, 1e-12);
  EXPECT_NEAR(network.stiffness.back(), 210.0 * 0.02 / 0.2, 1e-12);
  int breakable = 0;
  for (Index e = network.first_slip_spring; e < network.num_elements(); ++e) {
    if (network.is_segment(e)) {
      EXPECT_FALSE(network.can_break(e));
      continue;
    }
    const Index solid = network.bonds.first[e];
    const double length = std::max(network.bonds.lengths[e], 0.02);
    EXPECT_NEAR(network.stiffness[e],
                c * body.particles.volumes[solid] * body.lattice.cell_volume / length,
                1e-12 * network.stiffness[e]);
    const bool upper = network.particles.position(network.bonds.second[e])[1] > 0.75;
    EXPECT_EQ(network.critical_stretch[e], upper ? infinity : network.critical_stretch[0]);
    breakable += !upper;
  }
  EXPECT_GT(breakable, 0);
}

TEST(BuildNetwork, RefusesWhatDoesNotFit) {
  const LatticeInput body_of = two_materials(Surface::none);
  const Body body = make_body(body_of);
  NetworkInput input = network_input(body_of);
  EXPECT_THROW(build_network(body, input), std::invalid_argument);  // one material is missing
  input.materials.resize(2, {1.0, 1.0});
  input.problem = Problem::three_dimensional;
  EXPECT_THROW(build_network(body, input), std::invalid_argument);
  input.problem = Problem::plane_stress;
  input.horizon = 0.5 * body_of.spacing;
  EXPECT_THROW(build_network(body, input), std::invalid_argument);
  input.horizon = 2.0 * body_of.spacing;
  input.bars = {{{0.1, 0.5, 0.0}, {1.5, 0.5, 0.0}}};
  EXPECT_THROW(build_network(body, input), std::invalid_argument);  // no material of the bar
}

TEST(LooseParticles, HaveTooFewDirections) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  EXPECT_TRUE(find_loose_particles(network).empty());
  // Particle 2 keeps the bonds along its row only.
  for (Index b = 0; b < network.num_elements(); ++b) {
    if (network.bonds.first[b] != 2 && network.bonds.second[b] != 2) continue;
    if (std::abs(network.bonds.direction(b)[1]) > 1e-9) network.stiffness[b] = 0.0;
  }
  EXPECT_EQ(find_loose_particles(network), (std::vector<Index>{2}));
}

TEST(LooseParticles, OfACubicLatticeWithNearestBondsAreNone) {
  LatticeInput body_of = body_input({"", Pattern::cubic, Surface::none}, 3);
  body_of.horizon = body_of.spacing;
  EXPECT_TRUE(
      find_loose_particles(build_network(make_body(body_of), network_input(body_of))).empty());
}

TEST(BuildNetwork, CracksCutBondsAndTiesButNoBars) {
  const LatticeInput body_of = two_materials(Surface::none);
  const Body body = make_body(body_of);
  NetworkInput input = network_input(body_of);
  input.materials = {{30.0, 0.02}, {90.0, 0.06}};
  const Box& left = body_of.solid[0];
  const double x = 0.51 * left.upper[0], height = left.upper[1];
  input.bars = {{{0.1 * left.upper[0], 0.5 * height, 0}, {0.9 * left.upper[0], 0.5 * height, 0}}};
  input.bar_materials.resize(1);
  input.bar_materials[0].youngs_modulus = input.bar_materials[0].area = 1.0;
  const Network whole = build_network(body, input);
  input.cracks = {{{{x, -height, 0}, {x, 2.0 * height, 0}}}};
  const Network cracked = build_network(body, input);

  const auto across = [x](const Network& network, Index begin, Index end) {
    Index count = 0;
    for (Index e = begin; e < end; ++e) {
      const double from = network.particles.position(network.bonds.first[e])[0];
      const double to = network.particles.position(network.bonds.second[e])[0];
      count += (from < x) != (to < x);
    }
    return count;
  };
  const Index bonds = across(whole, 0, whole.first_slip_spring);
  EXPECT_GT(bonds, 0);
  EXPECT_GT(across(whole, whole.first_slip_spring, whole.first_bar_element), 0);
  EXPECT_EQ(across(cracked, 0, cracked.first_bar_element), 0);
  EXPECT_EQ(across(cracked, cracked.first_bar_element, cracked.num_elements()), 1);
  EXPECT_EQ(cracked.first_slip_spring, whole.first_slip_spring - bonds);
  EXPECT_EQ(cracked.report.cut_by_crack, std::vector<Index>{bonds});
  EXPECT_EQ(cracked.stiffness.size(), static_cast<std::size_t>(cracked.num_elements()));
}

}  // namespace
}  // namespace perilink
