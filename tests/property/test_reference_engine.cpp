// Every event engine follows the path of the reference: dense, solved completely at every event,
// searched exhaustively (support/reference_engine.hpp).

#include <gtest/gtest.h>

#include "support/engine_comparison.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_engine.hpp"

namespace perilink {
namespace {

using namespace test;

EquilibriumOptions iterative() {
  EquilibriumOptions options;
  options.solver = LinearSolver::iterative;
  options.subdomains.edge = 2;
  return options;
}

void add_direct(Comparison& comparison) {
  comparison.add("in place", with_route(FactorRoute::in_place));
  EquilibriumOptions threads;
  threads.threads = 2;
  comparison.add("two threads", threads);
  comparison.add("updated by CHOLMOD", with_route(FactorRoute::cholmod_updown));
  comparison.add("factorised anew", with_route(FactorRoute::refactorize));
}

class Reference : public testing::TestWithParam<RandomBody> {};

TEST_P(Reference, IsFollowedEventByEvent) {
  const LoadedNetwork body = random_body(GetParam());
  Comparison comparison(body, 0.0);
  add_direct(comparison);
  comparison.add("conjugate gradients", iterative(), of_gradients);
  comparison.follow(90);
  EXPECT_GT(comparison.tally().events, 10);
}

TEST_P(Reference, IsFollowedByBatches) {
  if (GetParam().laws == RandomLaws::brittle) return;  // brittle bonds fail one by one
  const LoadedNetwork body = random_body(GetParam());
  Comparison comparison(body, 0.1);
  add_direct(comparison);
  comparison.add("conjugate gradients", iterative(), of_gradients);
  comparison.follow(50);
  EXPECT_GT(comparison.tally().batches, 0);
}

std::vector<RandomBody> random_bodies() {
  std::vector<RandomBody> bodies;
  unsigned seed = 1;
  for (const int dim : {2, 3}) {
    for (const bool micropolar : {false, true}) {
      for (const bool driven : {false, true}) {
        for (const RandomLaws laws :
             {RandomLaws::brittle, RandomLaws::softening, RandomLaws::closing, RandomLaws::crushing,
              RandomLaws::mixed}) {
          if (laws == RandomLaws::crushing && !micropolar) continue;
          const bool supports = seed % 3 == 0, bar = seed % 2 == 0;
          bodies.push_back({seed++, dim, laws, micropolar, driven, supports, bar});
        }
      }
    }
  }
  return bodies;
}

INSTANTIATE_TEST_SUITE_P(Bodies, Reference, testing::ValuesIn(random_bodies()),
                         [](const auto& test) { return to_string(test.param); });

/// Returns the load factor of the first event of a load case alone.
double first_event_of(const LoadedNetwork& body, std::size_t set) {
  LoadedNetwork alone = body;
  alone.loads = body.sets[set].loads;
  alone.unknowns = body.sets[set].unknowns;
  alone.sets.clear();
  return ReferenceEngine(alone).next_event().load_factor;
}

class ReferenceStages : public testing::TestWithParam<RandomBody> {};

/// A weight, then events, unloading beyond zero, more events, and a second unloading.
TEST_P(ReferenceStages, AreFollowed) {
  const LoadedNetwork body = random_staged_body(GetParam());
  const double weight = 0.4 * first_event_of(body, 0), push = first_event_of(body, 1);
  for (const double tolerance : {0.0, 0.05}) {
    Comparison comparison(body, tolerance);
    add_direct(comparison);
    comparison.follow_stage(0, weight, 0);
    comparison.follow_stage(1, {}, GetParam().laws == RandomLaws::brittle ? 8 : 25);
    comparison.follow_stage(1, -0.2 * push, 0);
    comparison.follow_stage(1, {}, 20);
    comparison.follow_stage(0, 0.5 * weight, 0);  // without any load, no bond has a contact state
    comparison.follow_stage(1, 2.0 * push, 0);
    EXPECT_GT(comparison.tally().events, 10);
    if (GetParam().laws == RandomLaws::brittle) return;  // brittle bonds fail one by one
  }
}

std::vector<RandomBody> staged_bodies() {
  std::vector<RandomBody> bodies = random_bodies();
  // Bonds with a compressive branch have no stages.
  std::erase_if(bodies, [](const RandomBody& body) { return body.laws == RandomLaws::crushing; });
  return bodies;
}

INSTANTIATE_TEST_SUITE_P(Bodies, ReferenceStages, testing::ValuesIn(staged_bodies()),
                         [](const auto& test) { return to_string(test.param); });

}  // namespace
}  // namespace perilink
