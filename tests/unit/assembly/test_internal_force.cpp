#include "assembly/internal_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(InternalForce, OfOneElementByHand) {
  Network network;
  network.particles.positions = {0.0, 0.0, 3.0, 4.0};
  network.particles.volumes = {1.0, 1.0};
  network.bonds.append(network.particles, 0, 1);
  network.stiffness = {100.0};
  const std::vector<double> displacement = {0.0, 0.0, 0.5, 0.0};  // extension 0.6 * 0.5
  const InternalForce result = internal_force(network, std::vector<double>{0.5}, displacement);
  EXPECT_NEAR(result.energy, 0.5 * 50.0 * 0.3 * 0.3, 1e-15);
  // Tension 15: the far end must be pulled away, the near end held back.
  const std::vector<double> expected = {-9.0, -12.0, 9.0, 12.0};
  for (std::size_t slot = 0; slot < 4; ++slot) {
    EXPECT_NEAR(result.forces[slot], expected[slot], 1e-14);
  }
}

TEST(InternalForce, ReusesItsMemoryWithoutRemembering) {
  const Network network = make_network({"", Pattern::cubic, Surface::none}, 3);
  const auto secants = random_secants(network.num_elements(), 1);
  const auto displacement = random_vector(network.particles.positions.size(), 2);
  InternalForce again;
  internal_force(network, secants, displacement, again);
  internal_force(network, secants, displacement, again);
  const InternalForce fresh = internal_force(network, secants, displacement);
  EXPECT_EQ(again.forces, fresh.forces);
  EXPECT_EQ(again.energy, fresh.energy);
}

TEST(InternalForce, ElasticSupportsPullBackAndStoreEnergy) {
  Network network = make_network({"", Pattern::rectangular, Surface::none}, 3);
  const auto secants = random_secants(network.num_elements(), 1);
  const auto displacement = random_vector(network.particles.positions.size(), 2);
  const InternalForce without = internal_force(network, secants, displacement);
  network.support_stiffness.assign(displacement.size(), 0.0);
  network.support_stiffness[3] = 20.0;
  const InternalForce with = internal_force(network, secants, displacement);
  const double u = displacement[3];
  EXPECT_NEAR(with.energy, without.energy + 0.5 * 20.0 * u * u, 1e-14 * with.energy);
  for (std::size_t slot = 0; slot < displacement.size(); ++slot) {
    EXPECT_EQ(with.forces[slot], without.forces[slot] + (slot == 3 ? 20.0 * u : 0.0));
  }
}

TEST(InternalForce, WithoutSecantsAllIsIntact) {
  Network trusses = make_network({"", Pattern::cubic, Surface::none}, 3), states = trusses;
  states.states.emplace().stiffness.assign(static_cast<std::size_t>(states.particles.size()), 0.3);
  Network frames = trusses;
  frames.bending.assign(frames.stiffness.size(), 2.0);
  for (const Network* network : {&trusses, &states, &frames}) {
    const auto displacement =
        random_vector(static_cast<std::size_t>(network->particles.size()) * network->width(), 2);
    const std::vector<double> ones(static_cast<std::size_t>(network->num_elements()), 1.0);
    const InternalForce expected = internal_force(*network, ones, displacement);
    const InternalForce found = internal_force(*network, {}, displacement);
    EXPECT_EQ(found.forces, expected.forces);
    EXPECT_EQ(found.energy, expected.energy);
  }
}

}  // namespace
}  // namespace perilink
