#include "network/bond_strength.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "discretization/lattices/make_body.hpp"
#include "support/clouds.hpp"
#include "support/micropolar_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Round-off of sums over a few thousand bonds.
constexpr double strength_round_off = 1e-12;

bool has_facet(const Network& network, Index particle) {
  const std::vector<Index>& corners = network.facets.corners.values;
  return std::find(corners.begin(), corners.end(), particle) != corners.end();
}

/// Particles bonded to none on a facet.
std::set<Index> inner_particles(const Network& network) {
  std::set<Index> inner;
  for (Index i = 0; i < network.particles.size(); ++i) inner.insert(i);
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    if (!has_facet(network, i) && !has_facet(network, j)) continue;
    inner.erase(i);
    inner.erase(j);
  }
  return inner;
}

struct Sums {
  double volume = 0.0, axial = 0.0, bending = 0.0;
};

/// Over the inner particles of either material, with half of every bond.
Sums sums_of(const Network& network, Index a, Index b) {
  Sums sums;
  for (const Index i : inner_particles(network)) {
    const Index material = network.particles.material[i];
    if (material != a && material != b) continue;
    sums.volume += network.particles.volumes[i];
    for (Index e = 0; e < network.bonds.size(); ++e) {
      if (network.bonds.first[e] != i && network.bonds.second[e] != i) continue;
      const double share = 0.5 * std::pow(network.bonds.lengths[e], 3);
      sums.axial += share * network.stiffness[e];
      sums.bending += share * network.bending[e] / network.bending_ratio[e];
    }
  }
  return sums;
}

TEST(BondStrength, OfACloudReleasesTheFractureEnergy) {
  const NetworkInput input = unstructured_micropolar_input(14);
  const Network network = build_network(make_unstructured(1, 14), input);
  ASSERT_LT(network.report.calibration->smallest_weight, 0.9);
  const Sums inner = sums_of(network, 0, 0);
  ASSERT_GT(inner.volume, 0.0);
  const double energy = 0.5 * std::pow(network.critical_stretch[0], 2) * 2.0 / std::numbers::pi *
                        inner.axial / inner.volume;
  EXPECT_NEAR(energy, 0.02, strength_round_off * 0.02);
  for (const double stretch : network.critical_stretch) {
    EXPECT_EQ(stretch, network.critical_stretch[0]);
  }
}

/// Bending counts by the bond's length alone, and in the mean as much as the bonds hold.
TEST(BondStrength, OfACloudDoesNotDependOnTheCalibratedStiffness) {
  const NetworkInput input = unstructured_micropolar_input(14);
  const Network network = build_network(make_unstructured(1, 14), input);
  const Sums inner = sums_of(network, 0, 0);
  EXPECT_NEAR(inner.bending, inner.axial, strength_round_off * inner.axial);
  const auto of_unit_length = [&](Index e) {
    return network.bending_ratio[e] * std::pow(network.bonds.lengths[e], 2);
  };
  double least = INFINITY, largest = 0.0;  // what the ratio would be without
  for (Index e = 0; e < network.num_elements(); ++e) {
    EXPECT_NEAR(of_unit_length(e), of_unit_length(0), strength_round_off * of_unit_length(0));
    const double own = network.bending[e] / network.stiffness[e] / network.bending_ratio[e];
    least = std::min(least, own);
    largest = std::max(largest, own);
  }
  EXPECT_LT(least, 0.5);
  EXPECT_GT(largest, 2.0);
  // Within the changes of the calibration that of the infinite body.
  const MicropolarModuli moduli = moduli_of(make_unstructured(1, 14), input, input.materials[0]);
  EXPECT_NEAR(of_unit_length(0) / (12.0 * moduli.bending_modulus / moduli.micromodulus), 1.0, 0.2);
}

TEST(BondStrength, OfPairsOfMaterialsIsThatOfBothTogether) {
  NetworkInput input = unstructured_micropolar_input(18);
  input.materials = {{30.0, 0.02, 0.2}, {30.0, 0.05, 0.2}};
  const Network network = build_network(make_unstructured(2, 18), input);
  std::array<Sums, 3> sums;  // by the sum of the numbers of both materials
  for (const Index pair : {0, 1, 2}) sums[pair] = sums_of(network, pair / 2, (pair + 1) / 2);
  std::array<int, 3> found{};
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto [a, b] = materials_of_bond(network, e);
    const Sums& both = sums[a + b];
    ++found[a + b];
    const double energy = energy_between(input.materials[a], input.materials[b]);
    EXPECT_EQ(energy, a + b < 2 ? 0.02 : 0.05);
    const double sum = 2.0 / std::numbers::pi * both.axial / both.volume;
    EXPECT_NEAR(0.5 * std::pow(network.critical_stretch[e], 2) * sum, energy,
                strength_round_off * energy);
  }
  for (const int bonds : found) EXPECT_GT(bonds, 0);
}

TEST(BondStrength, WithoutAnInsideStaysThatOfTheInfiniteBody) {
  const NetworkInput input = unstructured_micropolar_input(4);
  const Body body = make_unstructured(1, 4);
  const Network network = build_network(body, input);
  ASSERT_TRUE(inner_particles(network).empty());
  const MicropolarModuli moduli = moduli_of(body, input, input.materials[0]);
  const double of_unit_length = 12.0 * moduli.bending_modulus / moduli.micromodulus;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const double square = std::pow(network.bonds.lengths[e], 2);
    EXPECT_NEAR(network.bending_ratio[e] * square, of_unit_length,
                strength_round_off * of_unit_length);
    EXPECT_EQ(network.critical_stretch[e], network.critical_stretch[0]);
  }
}

class StrengthOfLattice : public testing::TestWithParam<Pattern> {};

/// Near the surface bonds break like those inside with the same vector, and those break as they
/// are.
TEST_P(StrengthOfLattice, IsThatOfTheInside) {
  const bool plane = is_plane(GetParam());
  const LatticeInput of_body = body_input({"", GetParam(), Surface::calibrated}, plane ? 14 : 10);
  const Body body = make_body(of_body);
  const NetworkInput input = micropolar_input(of_body);
  const Network network = build_network(body, input);
  const LatticeNeighbourhoods neighbourhoods(body, input);
  const NeighbourhoodStiffness& inside = neighbourhoods.stiffness(0);
  Index changed = 0;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const Index k = neighbourhoods.find(network.bonds.direction(e), network.bonds.lengths[e]);
    if (k == no_index) continue;
    const double ratio = inside.bending[k] / inside.axial[k];
    EXPECT_NEAR(network.bending_ratio[e], ratio, strength_round_off * ratio);
    changed += std::abs(network.bending[e] / network.stiffness[e] - ratio) > 0.01 * ratio;
    if (network.stiffness[e] == inside.axial[k] && network.bending[e] == inside.bending[k]) {
      EXPECT_EQ(network.bending_ratio[e], ratio);
    }
  }
  EXPECT_GT(changed, 0);
}

INSTANTIATE_TEST_SUITE_P(BondStrength, StrengthOfLattice,
                         testing::Values(Pattern::rectangular, Pattern::hexagonal, Pattern::cubic));

TEST(BondStrength, TrussesHaveNoBendingRatio) {
  EXPECT_TRUE(
      own_bending_ratios(make_network({"", Pattern::rectangular, Surface::none}, 4)).empty());
  EXPECT_TRUE(
      make_network({"", Pattern::rectangular, Surface::calibrated}, 8).bending_ratio.empty());
}

}  // namespace
}  // namespace perilink
