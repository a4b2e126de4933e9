#include "network/builder/loose_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace perilink {
namespace {

/// Particles at the given places, solid, with no element yet.
Network loose_particles(int dim, std::vector<double> positions) {
  Network network;
  const std::size_t count = positions.size() / static_cast<std::size_t>(dim);
  network.particles.dim = dim;
  network.particles.positions = std::move(positions);
  network.particles.volumes.assign(count, 1.0);
  network.particles.material.assign(count, 0);
  network.particles.kind.assign(count, ParticleKind::solid);
  network.bonds.dim = dim;
  return network;
}

void bond(Network& network, Index i, Index j) {
  network.bonds.append(network.particles, i, j);
  network.stiffness.push_back(1.0);
  network.critical_stretch.push_back(1e-3);
}

std::vector<std::uint8_t> all_free(const Network& network) {
  return std::vector<std::uint8_t>(network.particles.positions.size(), 0);
}

/// A square with its diagonal; beside it a particle on one bond, a triangle that turns about a
/// corner of the square, and one that three bonds hold. Bonds of an open crack hold nothing.
TEST(LooseParts, AreThoseThatShiftOrTurnWithoutABond) {
  Network network = loose_particles(2, {0, 0,  1, 0,  0,   1,    1, 1,  // the square
                                        2, 1,                           // on one bond
                                        0, 2,  1, 2,                    // the triangle
                                        0, -2, 1, -2, 0.5, -1.5, 3, 3, 3, 4, 4, 4});
  for (const auto& [i, j] : std::vector<std::pair<Index, Index>>{
           {0, 1},   {0, 2},   {1, 3},   {2, 3},  {0, 3},  {1, 2}, {3, 4}, {2, 5},
           {2, 6},   {5, 6},   {7, 8},   {7, 9},  {8, 9},  {7, 0}, {8, 1}, {9, 1},
           {10, 11}, {11, 12}, {10, 12}, {3, 10}, {1, 10}, {3, 11}}) {
    bond(network, i, j);
  }
  auto held = all_free(network);
  EXPECT_EQ(find_fragments(network, held).size(), 1U);
  const auto free_of = [&](Index first) {
    for (const Fragment& part : find_loose_parts(network, held)) {
      if (part.particles.front() == first) return part.free_modes;
    }
    return 0;
  };
  // A triangle around a held corner is two particles on a bond each.
  EXPECT_EQ(find_loose_parts(network, held).size(), 3U);
  for (const Index i : {4, 5, 6}) EXPECT_EQ(free_of(i), 1);
  network.first_slip_spring = network.bonds.size();
  network.num_contacts = 3;
  EXPECT_EQ(free_of(10), 3);
  held[2 * 4 + 1] = 1;  // across the bond
  EXPECT_EQ(free_of(4), 0);
  EXPECT_EQ(find_loose_parts(network, held).size(), 3U);
}

/// In space a particle on two bonds is loose, a tetrahedron on a crystal's corner turns about it.
TEST(LooseParts, InSpaceNeedThreeDirections) {
  Network network = loose_particles(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2});
  for (Index i = 0; i < 4; ++i) {
    for (Index j = 0; j < i; ++j) bond(network, i, j);
  }
  for (const Index i : {1, 2, 3}) bond(network, i, 4);
  bond(network, 4, 5);
  bond(network, 3, 5);
  const std::vector<Fragment> loose = find_loose_parts(network, all_free(network));
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].particles, std::vector<Index>{5});
  EXPECT_EQ(loose[0].free_modes, 1);
}

/// Particles of a truss stay loose on one bond where a bar that bends makes the body carry moments.
TEST(LooseParts, BarsThatBendHoldNoParticlesOfATruss) {
  Network network = loose_particles(2, {0, 0, 1, 0, 0, 1, 2, 0.2, 5, 5, 6, 5});
  for (const auto& [i, j] :
       std::vector<std::pair<Index, Index>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {4, 5}}) {
    bond(network, i, j);
  }
  network.bending = {0, 0, 0, 0, 1};
  std::vector<std::uint8_t> held(6 * 3, 0);
  std::fill(held.begin() + 4 * 3, held.end(), 1);  // the bar
  const std::vector<Fragment> loose = find_loose_parts(network, held);
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].particles, std::vector<Index>{3});
  EXPECT_EQ(loose[0].free_modes, 1);
}

}  // namespace
}  // namespace perilink
