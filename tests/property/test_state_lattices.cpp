// Forces of state-based lattices are the derivative of their energy, and stiffness the derivative
// of forces. Rigid motions need no energy.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "assembly/internal_force.hpp"
#include "support/lattice_networks.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace testing_support;

class StateLattices : public testing::TestWithParam<StateLatticeCase> {
 protected:
  StateLattices() : network_(lattice_network(state_block(GetParam(), 3.1)).network) {
    secants_ = random_values(static_cast<std::size_t>(network_.num_elements()), 7, 0.0, 1.0);
  }
  double energy(const std::vector<double>& u) const {
    return internal_force(network_, secants_, u).energy;
  }
  Network network_;
  std::vector<double> secants_;
};

TEST_P(StateLattices, ForcesAreTheDerivativeOfTheEnergy) {
  std::vector<double> u = random_values(network_.particles.positions.size(), 8, -1.0, 1.0);
  const std::vector<double> forces = internal_force(network_, secants_, u).forces;
  double largest = 0.0;
  for (const double force : forces) largest = std::max(largest, std::abs(force));
  // The energy is quadratic: central differences are exact up to round-off.
  const double h = 1e-3;
  for (std::size_t slot = 0; slot < u.size(); slot += 5) {
    const double middle = u[slot];
    u[slot] = middle + h;
    const double above = energy(u);
    u[slot] = middle - h;
    const double below = energy(u);
    u[slot] = middle;
    // Round-off of an energy of several hundred terms over h.
    EXPECT_NEAR(forces[slot], (above - below) / (2.0 * h), 1e-9 * largest);
  }
}

TEST_P(StateLattices, RigidMotionsCostNothing) {
  const std::vector<double> u = test::linear_field(
      network_.particles, {{{0.0, -1.0, 0.4}, {1.0, 0.0, 0.3}, {-0.4, -0.3, 0.0}}});
  const std::vector<double> strained =
      test::linear_field(network_.particles, {{{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}});
  // Squares of round-off.
  EXPECT_LT(energy(u), 1e-24 * energy(strained));
}

/// Every stretch needs energy, for any ratio and missing bonds.
TEST_P(StateLattices, EnergiesArePositive) {
  std::fill(secants_.begin(), secants_.end(), 1.0);
  const std::size_t size = network_.particles.positions.size();
  for (unsigned seed = 0; seed < 20; ++seed) {
    EXPECT_GT(energy(random_values(size, seed, -1.0, 1.0)), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, StateLattices, testing::ValuesIn(state_lattice_cases()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace perilink
