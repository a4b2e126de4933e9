#include "network/builder/free_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// A square of 4 by 4 bonds with its rotations, where bonds have any.
AnalysisBody square(bool micropolar) {
  AnalysisBody body = make_block({.lattice = {"plane", Pattern::rectangular, Surface::none},
                                  .columns = 4,
                                  .micropolar = micropolar});
  body = free_body(body.network);
  number(body, [](Index, int) { return false; });
  return body;
}

TEST(FreeBodies, BrokenElementsConnectNothing) {
  const AnalysisBody body = square(false);
  std::vector<double> secants = intact(body.network);
  EXPECT_EQ(connected_parts(body.network, secants).size(), 1U);
  for (Index e = 0; e < body.network.num_elements(); ++e) {
    const auto x = [&](Index i) { return body.network.particles.position(i)[0]; };
    const double first = x(body.network.bonds.first[e]), second = x(body.network.bonds.second[e]);
    if ((first < 0.5) != (second < 0.5)) secants[e] = 0.0;
  }
  const std::vector<Fragment> parts = connected_parts(body.network, secants);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].particles.size() + parts[1].particles.size(),
            static_cast<std::size_t>(body.network.particles.size()));
}

TEST(FreeBodies, SpringsResistTheirComponents) {
  AnalysisBody body = square(false);
  EXPECT_EQ(free_motions(body.network, body.unknowns).size(), 3U);
  body.network.support_stiffness.assign(body.unknowns.number.size(), 0.0);
  body.network.support_stiffness[1] = 2.0;
  EXPECT_EQ(held_or_sprung(body.network, held_components(body.network, body.unknowns))[1], 1);
  EXPECT_EQ(free_motions(body.network, body.unknowns).size(), 2U);
  number(body, [](Index i, int) { return i < 2; });
  EXPECT_EQ(free_motions(body.network, body.unknowns).size(), 0U);
}

/// Particles of frames turn by the angle by which the body does, however large it is.
TEST(FreeBodies, ATurnStrainsNothingAndAShearDoes) {
  for (const bool micropolar : {false, true}) {
    const AnalysisBody body = square(micropolar);
    const Network& network = body.network;
    const std::vector<std::uint8_t> held(body.unknowns.number.size(), 1);
    std::vector<double> turn(held.size(), 0.0), shear(held.size(), 0.0);
    for (Index i = 0; i < network.particles.size(); ++i) {
      const auto x = network.particles.position(i);
      turn[slot(body, i, 0)] = 0.3 - 0.2 * x[1];
      turn[slot(body, i, 1)] = 0.2 * x[0];
      if (micropolar) turn[slot(body, i, 2)] = 0.2;
      shear[slot(body, i, 0)] = 0.1 * x[1];
    }
    const Fragment whole = connected_parts(network, {}).front();
    EXPECT_LT(strained_motion(network, whole, held, turn), 1e-14);
    EXPECT_GT(strained_motion(network, whole, held, shear), 1e-3);
    if (!micropolar) continue;
    for (const auto& motion : free_motions(network, body.unknowns)) {
      EXPECT_LT((dense_stiffness(network, {}) *
                 Eigen::Map<const Eigen::VectorXd>(motion.data(), motion.size()))
                    .norm(),
                1e-12);
    }
  }
}

/// What is left of loads does no work on any rigid motion, and a body force becomes nothing.
TEST(FreeBodies, LoadsAreBalancedByInertia) {
  for (const bool micropolar : {false, true}) {
    AnalysisBody body = square(micropolar);
    std::vector<double> mass(body.unknowns.number.size());
    for (std::size_t k = 0; k < mass.size(); ++k) mass[k] = 1.0 + static_cast<double>(k % 5);
    if (!micropolar) {
      for (std::size_t k = 1; k < mass.size(); k += 2) mass[k] = mass[k - 1];
    }
    const Fragment whole = connected_parts(body.network, {}).front();
    body.loads.forces.assign(mass.size(), 0.0);
    body.loads.forces[3] = 5.0;
    balance_loads(body.network, whole, mass, body.loads);
    for (const auto& motion : free_motions(body.network, body.unknowns)) {
      double work = 0.0;
      for (std::size_t k = 0; k < mass.size(); ++k) work += motion[k] * body.loads.forces[k];
      EXPECT_NEAR(work, 0.0, 1e-13);
    }
    EXPECT_GT(body.loads.forces[3], 1.0);
    for (std::size_t k = 0; k < mass.size(); ++k) {
      body.loads.forces[k] = k % body.unknowns.width == 1 ? 9.81 * mass[k] : 0.0;
    }
    balance_loads(body.network, whole, mass, body.loads);
    for (const double force : body.loads.forces) EXPECT_NEAR(force, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace perilink
