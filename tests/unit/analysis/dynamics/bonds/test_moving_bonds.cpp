#include "analysis/dynamics/bonds/moving_bonds.hpp"

#include <gtest/gtest.h>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double step_length = 0.1;

/// Two rows of two bonds of stiffness 3 in series. The left end is held, the right one moved or
/// pulled.
struct Chain {
  explicit Chain(bool driven, double limit = INFINITY)
      : problem(make_chains(2, 2, driven, 3.0, limit)),
        masses(lumped_inertia(problem.network, std::vector{1.0})),
        body(problem, masses, make_explicit_bonds(problem.network), step_length) {
    for (Index i = 0; i < problem.network.particles.size(); ++i) {
      if (problem.network.particles.position(i)[1] < 0.5) place[column(i)] = slot(problem, i, 0);
    }
  }
  std::size_t column(Index particle) const {
    return static_cast<std::size_t>(problem.network.particles.position(particle)[0] + 0.5);
  }
  /// Every particle moves as far as it is from the left end times the stretch.
  void stretch(double amount) {
    for (Index i = 0; i < problem.network.particles.size(); ++i) {
      body.motion.displacement[slot(problem, i, 0)] = amount * static_cast<double>(column(i));
    }
  }

  LoadedNetwork problem;
  Inertia masses;
  MovingBonds body;
  std::size_t place[3];  ///< motion of the lower row along x, from the left
};

TEST(MovingBonds, BeginAtRest) {
  Chain chain(true);
  for (const double value : chain.body.motion.displacement) EXPECT_EQ(value, 0.0);
  for (const double value : chain.body.motion.velocity) EXPECT_EQ(value, 0.0);
  EXPECT_EQ(chain.body.component, 0);
  EXPECT_TRUE(chain.body.is_held(chain.place[0]));
  EXPECT_FALSE(chain.body.is_held(chain.place[1]));
  EXPECT_TRUE(chain.body.state().broken.empty());
}

TEST(MovingBonds, ForcesAndEnergyIncludeSpringsOfSupports) {
  Chain chain(false);
  chain.problem.network.support_stiffness.assign(chain.body.force.size(), 0.0);
  chain.problem.network.support_stiffness[chain.place[1]] = 4.0;
  chain.stretch(0.25);
  chain.body.find_forces(0, 0);
  EXPECT_DOUBLE_EQ(chain.body.force[chain.place[0]], -0.75);
  EXPECT_DOUBLE_EQ(chain.body.force[chain.place[1]], 1.0);
  EXPECT_DOUBLE_EQ(chain.body.force[chain.place[2]], 0.75);
  EXPECT_DOUBLE_EQ(chain.body.stored(0, chain.problem.network.particles.size()),
                   4.0 * 0.5 * 3.0 * 0.0625 + 0.5 * 4.0 * 0.0625);
}

TEST(MovingBonds, BrokenBondsAreToldInOrderWithTheirEnergy) {
  Chain chain(true, 0.2);
  chain.stretch(0.25);
  chain.body.find_forces(0, 7);
  for (const double value : chain.body.force) EXPECT_EQ(value, 0.0);
  EXPECT_DOUBLE_EQ(chain.body.total().fractured, 4.0 * 0.5 * 3.0 * 0.0625);
  const std::vector<Index>& broken = chain.body.state().broken;
  EXPECT_EQ(broken.size(), 4U);
  EXPECT_TRUE(std::is_sorted(broken.begin(), broken.end()));
  ExplicitRecord record;
  chain.body.note_motion(chain.body.total(), 0.5, record);
  EXPECT_EQ(record.broken_bonds, 4);
  EXPECT_DOUBLE_EQ(record.displacement, 0.5);
}

TEST(MovingBonds, ReactionsOfDrivenParticlesAndSupportsAreCountedApart) {
  Chain chain(true);
  MotionSums& sums = chain.body.sums[0];
  chain.body.add_reaction(chain.place[0], -2.0, sums);
  chain.body.add_reaction(chain.place[0] + 1, 5.0, sums);  // across the load
  chain.body.add_reaction(chain.place[2], 3.0, sums);
  ExplicitRecord record;
  chain.body.note_reactions(chain.body.total(), 0.5, record);
  EXPECT_EQ(record.support_reaction, -2.0);
  EXPECT_EQ(record.load, 3.0);
}

TEST(MovingBonds, LoadsWorkOverTheDisplacementOfTheLoaded) {
  Chain chain(false);
  MotionSums sums;
  sums.loaded = 0.25;
  ExplicitRecord record;
  chain.body.note_reactions(sums, 0.5, record);
  chain.body.note_motion(sums, 0.5, record);
  EXPECT_EQ(record.load, 1.0);
  EXPECT_EQ(record.displacement, 0.125);
}

TEST(MovingBonds, GoOnFromASavedState) {
  Chain chain(true, 0.2);
  chain.stretch(0.25);
  chain.body.find_forces(0, 7);
  chain.body.sums[0].work = {3.0, 2.0};
  BondsState state;
  chain.body.save(state);
  Chain other(true, 0.2);
  other.body.restore(state);
  EXPECT_EQ(other.body.motion.displacement, chain.body.motion.displacement);
  EXPECT_EQ(other.body.state().broken, chain.body.state().broken);
  EXPECT_EQ(other.body.total().fractured, chain.body.total().fractured);
  EXPECT_EQ(other.body.total().work.external, 3.0);
  EXPECT_EQ(other.body.total().work.damping, 2.0);
  state.displacement.pop_back();
  EXPECT_THROW(Chain(true, 0.2).body.restore(state), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
