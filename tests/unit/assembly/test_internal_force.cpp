#include "assembly/internal_force.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numeric>

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

/// 900 000 bonds are taken in slabs. The list of all elements is gone through in one go; sums
/// differ in their order, some hundred terms of 1e-16.
TEST(InternalForce, DoesNotDependOnThreads) {
  LatticeInput lattice = body_input({"", Pattern::cubic, Surface::none}, 27);
  lattice.horizon = 3.0 * lattice.spacing;
  const Network network = build_network(make_body(lattice), network_input(lattice));
  ASSERT_GT(network.num_elements(), 900'000);
  const auto displacement = random_vector(network.particles.positions.size(), 2);
  std::vector<Index> all(static_cast<std::size_t>(network.num_elements()));
  std::iota(all.begin(), all.end(), 0);
  InternalForce one_go;
  internal_force(network, {}, displacement, all, one_go);
  double size = 0.0;
  for (const double force : one_go.forces) size = std::max(size, std::abs(force));
  const int before = omp_get_max_threads();
  std::vector<InternalForce> found;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    found.push_back(internal_force(network, {}, displacement));
    EXPECT_EQ(found.back().forces, found.front().forces);
    EXPECT_EQ(found.back().energy, found.front().energy);
  }
  omp_set_num_threads(before);
  EXPECT_NEAR(found.front().energy, one_go.energy, 1e-12 * one_go.energy);
  for (std::size_t k = 0; k < one_go.forces.size(); ++k) {
    ASSERT_NEAR(found.front().forces[k], one_go.forces[k], 1e-13 * size) << k;
  }
}

TEST(InternalForce, WithoutSecantsAllIsIntact) {
  Network trusses = make_network({"", Pattern::cubic, Surface::none}, 3), states = trusses;
  states.state_stiffness.assign(static_cast<std::size_t>(states.particles.size()), 0.3);
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
