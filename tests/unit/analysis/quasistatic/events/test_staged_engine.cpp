#include "analysis/quasistatic/events/staged_engine.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/staged_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// make_square() with a dead load of 1 at each end and the same as a growing one.
AnalysisBody twice_loaded_square() {
  AnalysisBody body = make_square();
  body.sets = {set_of(body), set_of(body)};
  return body;
}

/// Ends move by 2/3 of the load, bonds break at 0.01: at the load 0.015.
TEST(StagedEngine, StartsFromTheConstantLoad) {
  const AnalysisBody body = twice_loaded_square();
  StagedEngine engine(body, {});
  EXPECT_EQ(engine.next_event_towards(0.01).element, no_index);
  engine.move_to(0.01);
  EXPECT_NEAR(engine.displacement()[slot(body, 1, 0)] + engine.displacement()[slot(body, 3, 0)] +
                  engine.displacement()[slot(body, 2, 0)],
              2.0 * 0.02 / 3.0, 1e-16);
  engine.begin_stage(1, body.sets[1].unknowns);
  EXPECT_EQ(engine.load_factor(), 0.0);
  const Event up = engine.next_event_towards(1.0);
  EXPECT_NEAR(up.load_factor, 0.005, 1e-16);
  EXPECT_FALSE(up.at_constant_load);
  EXPECT_EQ(engine.next_event().element, up.element);
  EXPECT_EQ(engine.next_event_towards(-1.0).element, no_index) << "nothing is stretched";
  engine.begin_stage(0, body.sets[0].unknowns);
  EXPECT_EQ(engine.load_factor(), 0.01) << "it was left there";
}

/// Without its bond an end moves by twice the load, and the diagonal carries 0.02: the load falls
/// to 0.01, or the diagonal breaks at once.
TEST(StagedEngine, FollowsTheLoadDownUnlessItIsGiven) {
  const AnalysisBody body = twice_loaded_square();
  StagedEngine engine(body, {});
  engine.move_to(0.004);
  engine.begin_stage(1, body.sets[1].unknowns);
  const Event first = engine.next_event();
  EXPECT_NEAR(first.load_factor, 0.011, 1e-16);
  engine.move_to(first.load_factor);
  engine.apply(first);
  const Event next = engine.next_event();
  EXPECT_NEAR(next.load_factor, 0.006, 1e-16);
  EXPECT_FALSE(next.at_constant_load);
  const Event at_once = engine.next_event_towards(1.0);
  EXPECT_EQ(at_once.load_factor, first.load_factor);
  EXPECT_TRUE(at_once.at_constant_load);
  EXPECT_EQ(at_once.element, next.element);
}

/// Bonds in finite elements have alerts: theirs come first, and among bonds near them they count.
TEST(StagedEngine, KnowsWhatComesNearItsLimit) {
  const AnalysisBody body = twice_loaded_square();
  StagedEngine engine(body, {});
  const Event failure = engine.next_event();
  EXPECT_NEAR(failure.load_factor, 0.015, 1e-16);
  engine.set_release_threshold(std::vector<Index>{failure.element}, 0.5);
  const Event release_threshold = engine.next_event();
  EXPECT_EQ(release_threshold.element, failure.element);
  EXPECT_NEAR(release_threshold.load_factor, 0.0075, 1e-16);
  EXPECT_EQ(engine.near_events(release_threshold, 0.9), std::vector<Index>{failure.element});
  EXPECT_EQ(engine.load_factor(), 0.0) << "nothing has moved";
  engine.set_release_threshold(std::vector<Index>{failure.element}, 1.0);
  EXPECT_EQ(engine.next_event().load_factor, failure.load_factor);
}

/// Nothing becomes freer where the same unknowns move the particles.
TEST(StagedEngine, KeepsItsEquilibriumUnderTheSameMotion) {
  const AnalysisBody body = twice_loaded_square();
  StagedEngine engine(body, {});
  engine.move_to(0.004);
  engine.begin_stage(1, body.sets[1].unknowns);
  engine.move_to(0.002);
  const std::vector<double> before(engine.displacement().begin(), engine.displacement().end());
  const Freedom freedom = engine.change_motion(body.unknowns);
  EXPECT_NEAR(freedom.growth, 0.0, 1e-15);
  EXPECT_NEAR(freedom.beside.linear, 0.0, 1e-15);
  EXPECT_NEAR(freedom.beside.constant, 0.0, 1e-15);
  const std::span<const double> after = engine.displacement();
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-15);
}

}  // namespace
}  // namespace perilink
