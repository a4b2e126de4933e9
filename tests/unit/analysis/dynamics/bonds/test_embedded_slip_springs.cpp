#include "analysis/dynamics/bonds/embedded_slip_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "assembly/internal_force.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

Network barred(const ForceCurve& bond) {
  const LatticeInput body = body_input({"", Pattern::rectangular, Surface::none}, 6);
  NetworkInput input = network_input(body);
  RebarLine bar{{0.1, 0.43, 0.0}, {0.9, 0.57, 0.0}};
  bar.embedded = true;
  input.bars = {bar};
  BarMaterial material{200.0, 0.01};
  material.bond.perimeter = 0.4;
  material.bond.curve = bond;
  input.bar_materials = {material};
  Network network = build_network(make_body(body), input);
  for (Index e = 0; e < network.first_slip_spring; ++e) network.critical_stretch[e] = INFINITY;
  return network;
}

BondMotion motion_of(const Network& network, double size, double speed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  BondMotion motion;
  for (Index slot = 0; slot < 2 * network.particles.size(); ++slot) {
    const bool embedded_point = network.is_embedded_point(slot / 2);
    motion.displacement.push_back(embedded_point ? 0.0 : size * any(random));
    motion.velocity.push_back(embedded_point ? 0.0 : speed * any(random));
  }
  return motion;
}

/// Compares with the implicit analysis, embedded points included.
InternalForce expected_of(const Network& network, const std::vector<double>& secants,
                          std::vector<double> motion) {
  follow_particles(network, motion);
  InternalForce force = internal_force(network, secants, motion);
  load_particles(network, force.forces);
  return force;
}

TEST(EmbeddedSlipSprings, PullLikeThoseOfTheNetwork) {
  const Network network = barred({{{1e3, 3e6}}});
  const BondMotion motion = motion_of(network, 0.01, 0.0);
  const auto bonds = make_explicit_bonds(network);
  std::vector<double> force(motion.displacement.size(), 0.0);
  const Index count = network.particles.size();
  // In two calls, as blocks of particles do.
  bonds->forces(0, 10, 0.1, motion, force);
  bonds->forces(10, count, 0.1, motion, force);
  const InternalForce expected = expected_of(network, intact(network), motion.displacement);
  for (std::size_t slot = 0; slot < force.size(); ++slot) {
    EXPECT_NEAR(force[slot], expected.forces[slot], 1e-12 * expected.energy + 1e-12);
  }
  EXPECT_NEAR(bonds->stored(0, count, 0.1, motion), expected.energy, 1e-12 * expected.energy);
}

TEST(EmbeddedSlipSprings, FallFromToothToToothTogether) {
  const Network network = barred({{{1e-4, 0.3}, {1e-3, 0.4}}});
  const BondMotion motion = motion_of(network, 0.01, 0.0);
  const auto bonds = make_explicit_bonds(network);
  const Index count = network.particles.size();
  std::vector<double> force(motion.displacement.size(), 0.0);
  const BondLosses losses = bonds->forces(0, count, 0.1, motion, force);
  const std::vector<double> secants = bonds->secants();
  double fallen = 0.0;
  for (Index e = network.first_slip_spring; e < network.first_bar_element; e += 2) {
    EXPECT_LT(secants[e], 1.0);
    EXPECT_EQ(secants[e + 1], 1.0) << "across the bar";
    fallen += 1.0 - secants[e];
  }
  ASSERT_GT(fallen, 0.0);
  const InternalForce whole = expected_of(network, intact(network), motion.displacement);
  const InternalForce expected = expected_of(network, secants, motion.displacement);
  for (std::size_t slot = 0; slot < force.size(); ++slot) {
    EXPECT_NEAR(force[slot], expected.forces[slot], 1e-11 * whole.energy + 1e-12);
  }
  EXPECT_NEAR(losses.fractured, whole.energy - expected.energy, 1e-11 * whole.energy);
  EXPECT_TRUE(losses.broken.empty());
}

TEST(EmbeddedSlipSprings, RestoredOnesPullAsTheSavedOnes) {
  const Network network = barred({{{1e-4, 0.3}, {1e-3, 0.4}}});
  const auto bonds = make_explicit_bonds(network), restored = make_explicit_bonds(network);
  const Index count = network.particles.size();
  const BondMotion falling = motion_of(network, 0.003, 0.0), motion = motion_of(network, 0.01, 0.0);
  std::vector<double> expected(falling.displacement.size(), 0.0), found = expected;
  bonds->forces(0, count, 0.1, falling, expected);
  MovingElements state;
  bonds->save(state);
  restored->restore(state);
  EXPECT_NE(bonds->secants(), intact(network));
  EXPECT_EQ(restored->secants(), bonds->secants());
  const double lost = bonds->forces(0, count, 0.1, motion, expected).fractured;
  EXPECT_EQ(restored->forces(0, count, 0.1, motion, found).fractured, lost);
  EXPECT_EQ(found, expected);
  state.slip_segment.pop_back();
  EXPECT_THROW(restored->restore(state), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
