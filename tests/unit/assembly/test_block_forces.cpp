#include "assembly/block_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/internal_force.hpp"
#include "support/lattice_networks.hpp"
#include "support/micropolar_networks.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Each motion of the block by itself, by internal_force().
void expect_forces_of_each(const Network& network) {
  const auto slots = static_cast<std::size_t>(network.particles.size()) * network.width();
  const std::vector<double> secants = random_secants(network.num_elements(), 1);
  std::vector<double> axial = random_secants(network.num_elements(), 2);
  for (std::size_t e = 0; e < axial.size(); ++e) {
    if (secants[e] == 0.0) axial[e] = 0.0;
  }
  const Secants present(secants, axial);
  const std::vector<double> motions = random_vector(slots * block_width, 3);
  std::vector<double> forces(motions.size(), 7.0);
  block_forces(network, present, motions, forces);
  for (std::size_t c = 0; c < block_width; ++c) {
    std::vector<double> motion(slots);
    for (std::size_t k = 0; k < slots; ++k) motion[k] = motions[k * block_width + c];
    const InternalForce expected = internal_force(network, present, motion);
    double size = 0.0;
    for (const double force : expected.forces) size = std::max(size, std::abs(force));
    for (std::size_t k = 0; k < slots; ++k) {
      ASSERT_NEAR(forces[k * block_width + c], expected.forces[k], 1e-13 * size) << k << ' ' << c;
    }
  }
}

TEST(BlockForces, AreThoseOfEachMotion) {
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    const LatticeCase lattice{"", pattern, Surface::none};
    Network network = make_network(lattice, 4);
    expect_forces_of_each(network);
    network.support_stiffness.assign(network.particles.positions.size(), 0.0);
    network.support_stiffness[5] = 20.0;
    expect_forces_of_each(network);
    expect_forces_of_each(make_micropolar_network(lattice, 4));
  }
}

TEST(BlockForces, StatesCountAsWell) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 4);
  network.states.emplace().stiffness =
      random_vector(static_cast<std::size_t>(network.particles.size()), 4);
  expect_forces_of_each(network);
}

}  // namespace
}  // namespace perilink
