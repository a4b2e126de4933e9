#include "assembly/element_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

/// Two particles and one element of length 5 along (3, 4) / 5.
Network one_element() {
  Network network;
  network.particles.dim = 2;
  network.particles.positions = {0.0, 0.0, 3.0, 4.0};
  network.particles.volumes.assign(2, 1.0);
  network.particles.material.assign(2, 0);
  network.particles.kind.assign(2, ParticleKind::solid);
  network.bonds.append(network.particles, 0, 1);
  network.stiffness.assign(1, 9.0);
  return network;
}

TEST(ElementVector, HoldsTheRootOfTheStiffnessTimesTheDirection) {
  const Network network = one_element();
  const Unknowns unknowns = number_unknowns(2, {0, 0, 0, 0}, std::vector<double>(4, 0.0));

  const SparseVector x = element_vector(network, unknowns, 0, 9.0);

  ASSERT_EQ(x.size(), 4);
  const double expected[] = {-1.8, -2.4, 1.8, 2.4};  // 3 times (3, 4) / 5
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(x.rows[k], k);
    EXPECT_NEAR(x.values[k], expected[k], 1e-15);  // round-off
  }
}

TEST(ElementVector, LeavesOutPrescribedDisplacements) {
  const Network network = one_element();
  const Unknowns unknowns = number_unknowns(2, {1, 1, 0, 1}, std::vector<double>(4, 0.0));

  const SparseVector x = element_vector(network, unknowns, 0, 9.0);

  ASSERT_EQ(x.size(), 1);
  EXPECT_EQ(x.rows[0], 0);
  EXPECT_NEAR(x.values[0], 1.8, 1e-15);
}

}  // namespace
}  // namespace perilink
