// Every event engine follows the path of the reference: dense, solved completely at every event,
// searched exhaustively (support/reference_engine.hpp).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/events/staged_engine.hpp"
#include "support/analysis_bodies.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_engine.hpp"

namespace perilink {
namespace {

using namespace test;

/// Largest differences that round-off explains. Entries of a stiffness matrix have relative errors
/// of 1e-16, and the condition number of these bodies is up to 1e6 until they nearly separate;
/// displacements, and so load factors, have errors of 1e-10. Energies are products of two such
/// numbers and sums over events. Solves by conjugate gradients have errors of 1e-10 in the energy
/// norm.
struct Closeness {
  double load_factor = 1e-9, energy = 1e-8;
};
constexpr Closeness of_gradients{1e-7, 1e-6};

/// Growth of the compliance after which a body counts as nearly separated: the condition number
/// grows as much.
constexpr double nearly_separated = 1e4;

/// What a comparison has met.
struct Tally {
  int events = 0, broken = 0, yielded = 0, sides = 0, batches = 0, constant = 0, loose = 0;
  bool mechanism = false;
};

/// An engine and the reference, event by event.
class Pair {
 public:
  Pair(EventEngine& engine, ReferenceEngine& reference, const EquilibriumOptions& options,
       Closeness closeness = {})
      : engine_(engine),
        reference_(reference),
        tolerance_(options.event_tolerance),
        close_(closeness) {
    expect_equal_states();
    first_ = size();
  }

  /// Compares an event and applies it. \return whether the body goes on
  bool pass(const Event& event, const ReferenceEvent& expected, const LoadedNetwork& body) {
    expect_equal_events(event, expected, body);
    if (testing::Test::HasFailure() || event.element == no_index) return false;
    std::vector<Index> elements = {event.element};
    elements.insert(elements.end(), event.others.begin(), event.others.end());
    const double before = size();
    const EventOutcome outcome = engine_.apply(event);
    EventOutcome own;
    if (event.changes_side) {
      own = reference_.pass_side_change(direction_);
      ++tally.sides;
    } else {
      ReferenceEngine in_turn = reference_;
      own = reference_.apply(elements);
      if (elements.size() > 1) {
        const EventOutcome turn = in_turn.apply_in_turn(elements);
        if (own.mechanism) own = turn;
        // Elements that may separate the body fail one by one and release other energies.
        if (!near(outcome.released, own.released, before)) own.released = turn.released;
        ++tally.batches;
      }
      EXPECT_EQ(outcome.broken, own.broken) << row();
      EXPECT_EQ(outcome.yielded, own.yielded) << row();
    }
    EXPECT_EQ(outcome.mechanism, own.mechanism) << row();
    tally.mechanism = outcome.mechanism;
    tally.constant += event.at_constant_load;
    if (outcome.mechanism || testing::Test::HasFailure()) return false;
    expect_equal_outcomes(outcome, own, std::max(before, size()));
    ++tally.events;
    tally.broken += outcome.broken;
    tally.yielded += outcome.yielded;
    tally.loose += reference_.has_loose_parts();
    if (outcome.exhausted != no_index || is_nearly_separated()) return false;
    expect_equal_states();
    return !testing::Test::HasFailure();
  }

  void towards(double direction) { direction_ = direction; }

  void expect_equal_states() {
    const LoadWork work = engine_.load_work(), own = reference_.work();
    const double whole = size();
    const double factor = reference_.load_factor();
    EXPECT_TRUE(near(work.forces, own.forces, whole)) << row() << work.forces << " " << own.forces;
    EXPECT_TRUE(near(work.supports, own.supports, whole)) << row();
    const auto permanent = [&](const ConstantWork& terms) {
      return std::vector{terms.forces, factor * terms.forces_on_motion, terms.supports,
                         factor * terms.growing_forces, factor * terms.growing_supports};
    };
    const std::vector<double> terms = permanent(work.constant), own_terms = permanent(own.constant);
    double most = factor * factor * whole;
    for (const double term : own_terms) most = std::max(most, std::abs(term));
    for (std::size_t k = 0; k < terms.size(); ++k) {
      EXPECT_TRUE(near(terms[k], own_terms[k], most)) << row() << "permanent " << k;
    }
    expect_equal_motion();
    expect_equal_secants();
    if (tally.events % 10 == 0) {
      const double stored = engine_.check_equilibrium().stored_energy;
      EXPECT_TRUE(near(stored, reference_.stored_energy(), whole)) << row() << "stored";
    }
  }

  std::string row() const { return "event " + std::to_string(tally.events) + ": "; }

  Tally tally;

 private:
  bool near(double value, double expected, double scale) const {
    return std::abs(value - expected) <= close_.energy * scale;
  }
  double size() const {
    const LoadWork work = reference_.work();
    return work.forces + work.supports;
  }
  bool is_nearly_separated() const {
    return size() > nearly_separated * first_ || size() * nearly_separated < first_;
  }

  void expect_equal_motion() {
    const std::span<const double> motion = engine_.displacement();
    const Eigen::VectorXd own = reference_.is_staged()
                                    ? reference_.displacement_at(reference_.load_factor())
                                    : reference_.growing();
    const double largest = own.cwiseAbs().maxCoeff();
    const auto width = static_cast<std::size_t>(reference_.network().width());
    for (std::size_t slot = 0; slot < motion.size(); ++slot) {
      if (reference_.is_loose(static_cast<Index>(slot / width))) continue;
      EXPECT_NEAR(motion[slot], own[static_cast<Index>(slot)], close_.energy * largest)
          << row() << "slot " << slot;
    }
  }

  void expect_equal_secants() const {
    const Secants secants = engine_.secants(), own = reference_.secants();
    for (Index e = 0; e < reference_.network().num_elements(); ++e) {
      EXPECT_EQ(secants[e], own[e]) << row() << "element " << e;
      if (!reference_.has_side(e)) continue;
      EXPECT_EQ(secants.axial(e), own.axial(e)) << row() << "element " << e;
    }
  }

  /// The reference names every element that ties, within tie_tolerance and round-off. The engine
  /// chooses one of them.
  void expect_equal_events(const Event& event, const ReferenceEvent& expected,
                           const LoadedNetwork& body) const {
    ASSERT_EQ(event.element == no_index, expected.elements.empty()) << row();
    if (event.element == no_index) return;
    EXPECT_EQ(event.changes_side, expected.changes_side) << row();
    EXPECT_EQ(event.at_constant_load, expected.at_constant_load) << row();
    if (!event.changes_side) {
      EXPECT_TRUE(std::ranges::binary_search(expected.elements, event.element))
          << row() << "element " << event.element << ", not " << expected.elements.front();
    }
    double load_factor = expected.load_factor;
    if (!event.others.empty()) load_factor = middle_of(event, load_factor, body);
    EXPECT_NEAR(event.load_factor, load_factor, close_.load_factor * std::abs(load_factor))
        << row();
  }

  /// Checks that the elements of a batch are within the tolerance. \return its load factor
  double middle_of(const Event& event, double first, const LoadedNetwork& body) const {
    if (!body.sets.empty()) {
      for (const Index other : event.others) {
        EXPECT_GE(reference_.ratio_at(event.load_factor, other),
                  1.0 - (event.at_constant_load ? 0.0 : 0.5 * tolerance_) - close_.load_factor)
            << row() << "element " << other;
      }
      return first;
    }
    double least = 1.0 / first;
    for (const Index other : event.others) least = std::min(least, reference_.ratio(other));
    EXPECT_GE(least * first, 1.0 - tolerance_ - close_.load_factor) << row();
    return 2.0 / (1.0 / first + least);
  }

  void expect_equal_outcomes(const EventOutcome& outcome, const EventOutcome& own,
                             double scale) const {
    EXPECT_TRUE(near(outcome.compliance_growth, own.compliance_growth, scale))
        << row() << outcome.compliance_growth << " " << own.compliance_growth;
    EXPECT_TRUE(near(outcome.released, own.released, scale))
        << row() << outcome.released << " " << own.released;
    const double factor = reference_.load_factor(), most = factor * factor * scale;
    EXPECT_TRUE(near(outcome.permanent_growth.at(factor), own.permanent_growth.at(factor), most))
        << row();
    if (tolerance_ > 0.0) return;
    EXPECT_TRUE(
        near(outcome.released_by_permanent.at(factor), own.released_by_permanent.at(factor), most))
        << row();
  }

  EventEngine& engine_;
  ReferenceEngine& reference_;
  double tolerance_, first_ = 1.0;
  Closeness close_;
  double direction_ = 1.0;
};

/// Follows a body without load cases. Loose parts with closing bonds end the comparison: their
/// position is the engine's choice.
Tally follow(const LoadedNetwork& body, const EquilibriumOptions& options,
             Closeness closeness = {}) {
  constexpr int most = 300;
  const std::unique_ptr<EventEngine> engine = make_event_engine(body, options);
  ReferenceEngine reference(body, options.event_tolerance);
  Pair pair(*engine, reference, options, closeness);
  while (pair.tally.events < most && !engine->load_work().separated) {
    if (reference.has_loose_parts() && body.network.has_closing()) break;
    if (!pair.pass(engine->next_event(), reference.next_event(), body)) break;
  }
  return pair.tally;
}

class Reference : public testing::TestWithParam<RandomBody> {
 protected:
  LoadedNetwork body_ = random_body(GetParam());
};

void expect_path(const Tally& tally, const RandomBody& choice) {
  EXPECT_GT(tally.events, 5) << "hardly an event";
  std::printf("%s: events %d broken %d yielded %d sides %d batches %d loose %d mech %d\n",
              to_string(choice).c_str(), tally.events, tally.broken, tally.yielded, tally.sides,
              tally.batches, tally.loose, tally.mechanism);
}

TEST_P(Reference, IsFollowedByEveryFactorRoute) {
  for (const FactorRoute route : routes) expect_path(follow(body_, with_route(route)), GetParam());
}

TEST_P(Reference, IsFollowedByTwoThreads) {
  EquilibriumOptions options;
  options.threads = 2;
  expect_path(follow(body_, options), GetParam());
}

TEST_P(Reference, IsFollowedByConjugateGradients) {
  EquilibriumOptions options;
  options.solver = LinearSolver::iterative;
  options.subdomains.edge = 2;
  expect_path(follow(body_, options, of_gradients), GetParam());
}

TEST_P(Reference, IsFollowedByBatches) {
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
    EquilibriumOptions options;
    options.event_tolerance = 0.1;
    options.solver = solver;
    options.subdomains.edge = 2;
    expect_path(follow(body_, options, solver == LinearSolver::direct ? Closeness{} : of_gradients),
                GetParam());
  }
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

/// A stage of a comparison: a load case moves to a load factor, or by some events.
struct Stage {
  std::size_t set;
  std::optional<double> to;
  int events = 0;
};

/// Follows a body with load cases through stages, as EventRun does.
Tally follow_stages(const LoadedNetwork& body, const EquilibriumOptions& options,
                    const std::vector<Stage>& stages) {
  StagedEngine engine(body, options);
  ReferenceEngine reference(body, options.event_tolerance);
  EXPECT_EQ(engine.open_for(1.0).mechanism, !reference.open_for(1.0));
  Pair pair(engine, reference, options);
  std::size_t set = 0;
  for (const Stage& stage : stages) {
    if (stage.set != set) {
      engine.begin_stage(stage.set, body.sets[stage.set].unknowns);
      reference.begin_stage(stage.set);
      pair.expect_equal_states();
      set = stage.set;
    }
    for (int failed = 0; stage.to || failed < stage.events;) {
      if (engine.load_work().separated) return pair.tally;
      if (reference.has_loose_parts() && body.network.has_closing()) return pair.tally;
      const Event event = stage.to ? engine.next_event_towards(*stage.to) : engine.next_event();
      const ReferenceEvent expected =
          stage.to ? reference.next_event_towards(*stage.to) : reference.next_event();
      const bool arrived = event.element == no_index;
      const double load_factor = arrived ? stage.to.value_or(0.0) : event.load_factor;
      const double before = engine.load_factor();
      pair.towards(load_factor < before ? -1.0 : 1.0);
      engine.move_to(load_factor);
      reference.move_to(load_factor);
      if (!pair.pass(event, expected, body)) {
        if (!arrived || testing::Test::HasFailure()) return pair.tally;
        break;
      }
      failed += !event.changes_side;
    }
  }
  return pair.tally;
}

/// Returns the load factor of the first event of a load case alone.
double first_event_of(const LoadedNetwork& body, std::size_t set) {
  LoadedNetwork alone = body;
  alone.loads = body.sets[set].loads;
  alone.unknowns = body.sets[set].unknowns;
  alone.sets.clear();
  return ReferenceEngine(alone).next_event().load_factor;
}

class ReferenceStages : public testing::TestWithParam<RandomBody> {};

/// A weight, then events, unloading beyond zero, and more events.
TEST_P(ReferenceStages, AreFollowed) {
  const LoadedNetwork body = random_staged_body(GetParam());
  const double weight = 0.4 * first_event_of(body, 0), push = first_event_of(body, 1);
  for (const double tolerance : {0.0, 0.05}) {
    EquilibriumOptions options;
    options.event_tolerance = tolerance;
    const Tally tally = follow_stages(
        body, options,
        {{0, weight}, {1, {}, 25}, {1, -0.2 * push}, {1, {}, 20}, {0, 0.0}, {1, 2.0 * push}});
    expect_path(tally, GetParam());
  }
}

std::vector<RandomBody> staged_bodies() {
  std::vector<RandomBody> bodies = random_bodies();
  std::erase_if(bodies, [](const RandomBody& body) { return body.laws == RandomLaws::crushing; });
  return bodies;
}

INSTANTIATE_TEST_SUITE_P(Bodies, ReferenceStages, testing::ValuesIn(staged_bodies()),
                         [](const auto& test) { return to_string(test.param); });

}  // namespace
}  // namespace perilink
