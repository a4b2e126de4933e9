#include "assembly/results/crack_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discretization/bonds.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

/// A lattice of 9 by 9 particles, whose upper part (from y = 0.9 on) moves away from the lower one.
class CrackOpeningsTest : public testing::Test {
 protected:
  CrackOpeningsTest()
      : network(test::make_network({"", Pattern::rectangular, Surface::none}, 8)),
        neighbourhoods(bonds_of_particles(network.bonds, network.particles.size())),
        secants(static_cast<std::size_t>(network.num_elements()), 1.0) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (is_above(network.bonds.first[e]) != is_above(network.bonds.second[e])) {
        crossing.push_back(e);
      }
    }
  }
  bool is_above(Index i) const { return network.particles.position(i)[1] > 0.9; }
  void damage(double secant) {
    for (const Index e : crossing) secants[e] = secant;
  }
  std::vector<double> moved_apart(double along, double across) const {
    std::vector<double> motion;
    for (Index i = 0; i < network.particles.size(); ++i) {
      motion.push_back(is_above(i) ? along : 0.0);
      motion.push_back(is_above(i) ? across : 0.0);
    }
    return motion;
  }
  CrackOpenings openings(std::span<const double> motion) const {
    return crack_openings(network, neighbourhoods, secants, motion);
  }

  static double largest(const CrackOpenings& found) {
    return *std::max_element(found.opening.begin(), found.opening.end());
  }

  /// Whether the families of both ends are whole.
  bool is_inside(Index bond) const {
    const double i = network.particles.position(network.bonds.first[bond])[0];
    const double j = network.particles.position(network.bonds.second[bond])[0];
    return std::min(i, j) > 0.45 && std::max(i, j) < 1.15;
  }

  Network network;
  Csr neighbourhoods;
  std::vector<double> secants;
  std::vector<Index> crossing;
};

TEST_F(CrackOpeningsTest, EveryBondOfACrackThatOpensEvenlyShowsItsOpening) {
  damage(0.0);
  const CrackOpenings found = openings(moved_apart(0.0, 0.02));
  EXPECT_EQ(found.bonds, crossing);
  // At the ends of the crack families lie on one side; their axes turn by a few degrees.
  EXPECT_NEAR(largest(found), 0.02, 2e-4);
  for (std::size_t k = 0; k < found.bonds.size(); ++k) {
    if (is_inside(found.bonds[k])) {
      EXPECT_NEAR(found.opening[k], 0.02, 1e-12);
    }
  }
}

TEST_F(CrackOpeningsTest, SlidingOpensNothing) {
  damage(0.0);
  const CrackOpenings found = openings(moved_apart(0.02, 0.0));
  for (std::size_t k = 0; k < found.bonds.size(); ++k) {
    if (is_inside(found.bonds[k])) {
      EXPECT_NEAR(found.opening[k], 0.0, 1e-12);
    }
  }
}

/// What a bond would open by without damage is its stretch at the same force.
TEST_F(CrackOpeningsTest, SoftenedBondsOpenByWhatTheyHaveLost) {
  damage(0.25);
  EXPECT_NEAR(largest(openings(moved_apart(0.0, 0.02))), 0.75 * 0.02, 2e-4);
  damage(0.75);
  EXPECT_TRUE(openings(moved_apart(0.0, 0.02)).bonds.empty()) << "most of them is left";
}

TEST_F(CrackOpeningsTest, PressedFacesAreClosed) {
  damage(0.0);
  const CrackOpenings found = openings(moved_apart(0.0, -0.02));
  EXPECT_EQ(found.bonds, crossing);
  EXPECT_EQ(largest(found), 0.0);
}

TEST_F(CrackOpeningsTest, AParticleHasTheLargestOfItsBonds) {
  damage(0.0);
  const CrackOpenings found = openings(moved_apart(0.0, 0.02));
  const std::vector<double> at = openings_at_particles(network, found);
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double away = std::abs(network.particles.position(i)[1] - 0.9);
    const double x = network.particles.position(i)[0];
    if (away > 0.5) {
      EXPECT_EQ(at[i], 0.0);
    }
    if (away < 0.15 && x > 0.75 && x < 0.85) {
      EXPECT_NEAR(at[i], 0.02, 2e-4);
    }
  }
}

}  // namespace
}  // namespace perilink
