// Unstructured state-based particles: forces are the derivative of the energy, rigid motions need
// no energy, every deformation needs energy.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "assembly/internal_force.hpp"
#include "support/particle_clouds.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using test::random_numbers;

class StateParticles : public testing::TestWithParam<int> {
 protected:
  StateParticles()
      : network_(test::unstructured_particles(GetParam(), GetParam() == 2 ? 8 : 4).network) {
    secants_ = random_numbers(static_cast<std::size_t>(network_.num_elements()), 7, 0.0, 1.0);
    for (std::size_t e = 0; e < secants_.size(); e += 6) secants_[e] = 0.0;
  }
  double energy(const std::vector<double>& u) const {
    return internal_force(network_, secants_, u).energy;
  }
  Network network_;
  std::vector<double> secants_;
};

TEST_P(StateParticles, ForcesAreTheDerivativeOfTheEnergy) {
  std::vector<double> u = random_numbers(network_.particles.positions.size(), 8, -1.0, 1.0);
  const std::vector<double> forces = internal_force(network_, secants_, u).forces;
  double largest = 0.0;
  for (const double force : forces) largest = std::max(largest, std::abs(force));
  // The energy is quadratic: central differences are exact up to round-off.
  const double h = 1e-3;
  for (std::size_t slot = 0; slot < u.size(); slot += 3) {
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

TEST_P(StateParticles, RigidMotionsCostNothing) {
  const std::vector<double> u = test::linear_field(
      network_.particles, {{{0.0, -1.0, 0.4}, {1.0, 0.0, 0.3}, {-0.4, -0.3, 0.0}}});
  const std::vector<double> strained =
      test::linear_field(network_.particles, {{{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}});
  EXPECT_LT(energy(u), 1e-24 * energy(strained));  // squares of round-off
}

TEST_P(StateParticles, EnergiesArePositive) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    EXPECT_GT(energy(random_numbers(network_.particles.positions.size(), seed, -1.0, 1.0)), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, StateParticles, testing::Values(2, 3));

}  // namespace
}  // namespace perilink
