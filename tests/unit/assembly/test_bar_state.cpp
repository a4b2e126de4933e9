#include "assembly/bar_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// A block with a bar along x, from 0.01 to 0.01 before its end: E = 200, A = 0.005.
AnalysisBody block(bool space, bool micropolar = false) {
  BlockCase shape{{"", space ? Pattern::cubic : Pattern::rectangular, Surface::none}, false, true};
  shape.micropolar = micropolar;
  return make_block(shape);
}

/// All particles move by a linear field, which bends nothing: rotations are zero.
std::vector<double> linear_motion(const Network& network) {
  std::vector<double> motion(network.particles.positions.size() / network.dim() * network.width());
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    double* u = motion.data() + static_cast<std::size_t>(i) * network.width();
    u[0] = 0.3 + 0.002 * x[0] - 0.001 * x[1];
    u[1] = -0.1 + 0.004 * x[0] + 0.003 * x[1];
  }
  return motion;
}

const double perimeter = std::sqrt(4.0 * std::numbers::pi * 0.005);

double length_of(const Network& network, std::size_t segment) {
  return network.bonds.lengths[network.first_bar_element + static_cast<Index>(segment)];
}

TEST(BarState, InAUniformStrainBarsBearItAndDoNotSlip) {
  for (const bool space : {false, true}) {
    for (const bool micropolar : {false, true}) {
      const AnalysisBody body = block(space, micropolar);
      const Network& network = body.network;
      ASSERT_FALSE(network.bars.bar.empty());
      const BarState state = bar_state(network, intact(network), linear_motion(network));
      ASSERT_EQ(state.force.size(), network.bars.bar.size());
      for (std::size_t s = 0; s < state.force.size(); ++s) {
        EXPECT_NEAR(state.strain[s], 0.002, 1e-14);
        EXPECT_NEAR(state.stress[s], 200.0 * 0.002, 1e-11);
        EXPECT_NEAR(state.force[s], 200.0 * 0.005 * 0.002, 1e-13);
        EXPECT_NEAR(state.slip[s], 0.0, 1e-13);
        // An end gives its force over half a segment; a segment has the mean of its ends.
        const double end = state.force[s] / length_of(network, s) / perimeter;
        const bool first = s == 0, last = s + 1 == state.force.size();
        EXPECT_NEAR(state.bond_stress[s], (first ? end : 0.0) - (last ? end : 0.0), 1e-11);
      }
    }
  }
}

/// The bar alone moves along itself by a quadratic field: it slips by that, and its force grows
/// evenly.
TEST(BarState, ABarThatIsPulledThroughTheSolidSlipsAndGivesItsForceToIt) {
  AnalysisBody body = block(false);
  const Network& network = body.network;
  std::vector<double> motion(network.particles.positions.size(), 0.0);
  const double grown = 0.03;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double x = network.particles.position(i)[0];
    if (network.particles.kind[i] == ParticleKind::rebar) {
      motion[slot(body, i, 0)] = 0.01 + 0.5 * grown * x * x;
    }
  }
  const BarState state = bar_state(network, intact(network), motion);
  for (std::size_t s = 0; s < state.force.size(); ++s) {
    const Index e = network.first_bar_element + static_cast<Index>(s);
    const double a = network.particles.position(network.bonds.first[e])[0];
    const double b = network.particles.position(network.bonds.second[e])[0];
    EXPECT_NEAR(state.strain[s], 0.5 * grown * (a + b), 1e-13);
    EXPECT_NEAR(state.slip[s], 0.01 + 0.25 * grown * (a * a + b * b), 1e-13);
    if (s == 0 || s + 1 == state.force.size()) continue;
    EXPECT_NEAR(state.bond_stress[s], 200.0 * 0.005 * grown / perimeter, 1e-11);
  }
}

/// All that the bar gives to the solid adds up to nothing.
TEST(BarState, BondStressesAddUpToNothing) {
  const AnalysisBody body = block(false);
  const Network& network = body.network;
  std::vector<double> motion(network.particles.positions.size(), 0.0);
  for (Index i = 0; i < network.particles.size(); ++i) {
    const double x = network.particles.position(i)[0];
    if (network.particles.kind[i] == ParticleKind::rebar)
      motion[slot(body, i, 0)] = x * x * (1 - x);
  }
  const BarState state = bar_state(network, intact(network), motion);
  double given = 0.0, size = 0.0;
  for (std::size_t s = 0; s < state.force.size(); ++s) {
    given += state.bond_stress[s] * perimeter * length_of(network, s);
    size = std::max(size, std::abs(state.force[s]));
  }
  ASSERT_GT(size, 0.01);
  EXPECT_NEAR(given, 0.0, 1e-12);
}

/// Numbers of nodes may fall along a bar; what it bears is the same.
TEST(BarState, SlipCountsTowardsTheEndOfTheBar) {
  AnalysisBody body = block(false);
  Network turned = body.network;
  for (std::size_t s = 0; s < turned.bars.bar.size(); ++s) {
    const std::size_t e = static_cast<std::size_t>(turned.first_bar_element) + s;
    std::swap(turned.bonds.first[e], turned.bonds.second[e]);
    for (std::size_t a = 0; a < 2; ++a) turned.bonds.directions[2 * e + a] *= -1.0;
    turned.bars.turned[s] = !turned.bars.turned[s];
  }
  std::vector<double> motion(body.network.particles.positions.size(), 0.0);
  for (Index i = 0; i < body.network.particles.size(); ++i) {
    if (body.network.particles.kind[i] == ParticleKind::rebar) motion[slot(body, i, 0)] = 0.01;
  }
  const std::vector<double> secants = intact(body.network);
  EXPECT_EQ(bar_state(body.network, secants, motion).slip, bar_state(turned, secants, motion).slip);
  EXPECT_NEAR(bar_state(turned, secants, motion).slip[0], 0.01, 1e-15);
}

}  // namespace
}  // namespace perilink
