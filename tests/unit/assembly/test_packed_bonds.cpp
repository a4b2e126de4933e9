#include "assembly/packed_bonds.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numeric>

#include "assembly/block_forces.hpp"
#include "assembly/internal_force.hpp"
#include "support/lattice_networks.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

/// Last particle first.
std::vector<Index> backwards(const Network& network) {
  std::vector<Index> place(static_cast<std::size_t>(network.particles.size()));
  std::iota(place.rbegin(), place.rend(), 0);
  return place;
}

/// All in one part, or in three of which one has no particle.
std::vector<std::vector<std::size_t>> parts_of(const Network& network) {
  const std::size_t all = static_cast<std::size_t>(network.particles.size());
  return {{all}, {all / 3, all / 3, all}};
}

/// One motion in double precision: bonds have seven digits, and errors of all of them would have to
/// add up to reach the tolerance.
void expect_forces_of_one(const PackedBonds& bonds, const Network& network, Secants secants) {
  const std::vector<Index> place = backwards(network);
  const auto dim = static_cast<std::size_t>(network.dim());
  const std::size_t row = PackedBonds::row_size(network.dim());
  const std::vector<double> motion = random_vector(place.size() * dim, 5);
  const InternalForce expected = internal_force(network, secants, motion);
  BlockVector<double> packed(place.size() * row, 0.0), forces(packed.size(), 7.0);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    packed[place[k / dim] * row + k % dim] = motion[k];
  }
  bonds.forces(packed, forces);
  double size = 0.0;
  for (const double force : expected.forces) size = std::max(size, std::abs(force));
  for (std::size_t k = 0; k < motion.size(); ++k) {
    ASSERT_NEAR(bonds.unit() * forces[place[k / dim] * row + k % dim], expected.forces[k],
                1e-6 * size);
  }
}

/// Seven digits of each of some hundred terms.
void expect_forces(const PackedBonds& bonds, const std::vector<std::size_t>& parts,
                   const Network& network, Secants secants, double unit) {
  const std::vector<Index> place = backwards(network);
  const std::size_t row = static_cast<std::size_t>(network.dim()) * block_width;
  const std::vector<double> motions = random_vector(place.size() * row, 3);
  std::vector<double> expected(motions.size());
  block_forces(network, secants, motions, expected);
  std::vector<float> packed(motions.size()), forces(motions.size(), 7.0F);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    packed[place[k / row] * row + k % row] = static_cast<float>(motions[k]);
  }
  std::vector<std::size_t> complete = parts;  // up to where parts have been told of
  for (std::size_t part = 0; part < parts.size(); ++part) {
    complete[part] = part == 0 ? 0 : parts[part - 1];
  }
  bonds.forces(packed, forces, [&](std::size_t part, std::size_t begin, std::size_t end) {
    EXPECT_EQ(begin, complete[part]);
    complete[part] = end;
  });
  EXPECT_EQ(complete, parts);
  double size = 0.0;
  for (const double force : expected) size = std::max(size, std::abs(force));
  for (std::size_t k = 0; k < motions.size(); ++k) {
    ASSERT_NEAR(unit * forces[place[k / row] * row + k % row], expected[k], 1e-5 * size) << k;
  }
  expect_forces_of_one(bonds, network, secants);
}

TEST(PackedBonds, PullAsThoseOfTheNetwork) {
  for (const Pattern pattern : {Pattern::hexagonal, Pattern::cubic}) {
    const Network network = make_network({"", pattern, Surface::none}, 4);
    std::vector<double> secants = random_secants(network.num_elements(), 1);
    const double unit = 3.0 * network.stiffness[0];
    for (const auto& parts : parts_of(network)) {
      const PackedBonds bonds(network, secants, backwards(network), unit, parts);
      expect_forces(bonds, parts, network, secants, unit);
    }
  }
}

TEST(PackedBonds, FollowWhatHasChanged) {
  Network network = make_network({"", Pattern::cubic, Surface::none}, 4);
  // Two bonds between the same particles.
  network.bonds.second[1] = network.bonds.second[0];
  network.stiffness[1] = 0.3 * network.stiffness[0];
  const double unit = network.stiffness[0];
  for (const auto& parts : parts_of(network)) {
    std::vector<double> secants(static_cast<std::size_t>(network.num_elements()), 1.0);
    secants[3] = 0.0;
    PackedBonds bonds(network, secants, backwards(network), unit, parts);
    secants[0] = 0.0;
    secants[1] = 0.5;
    secants[7] = 0.25;
    bonds.follow(secants);
    expect_forces(bonds, parts, network, secants, unit);
    secants[0] = secants[3] = 1.0;  // whole again
    secants[7] = 0.0;
    bonds.follow(secants);
    expect_forces(bonds, parts, network, secants, unit);
  }
}

TEST(PackedBonds, ForcesDoNotDependOnThreads) {
  const Network network = make_network({"", Pattern::cubic, Surface::none}, 8);
  const std::vector<Index> place = backwards(network);
  const std::size_t all = place.size();
  const PackedBonds bonds(network, {}, place, 1.0, std::vector{all / 4, all / 2, all});
  BlockVector<double> motion(all * 4, 0.0), forces(motion.size());
  const std::vector<double> random = random_vector(all * 3, 2);
  for (std::size_t k = 0; k < random.size(); ++k) motion[k / 3 * 4 + k % 3] = random[k];
  const int before = omp_get_max_threads();
  BlockVector<double> first;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    bonds.forces(motion, forces);
    if (threads == 1) first = forces;
    EXPECT_EQ(forces, first);
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace perilink
