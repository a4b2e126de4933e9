#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quasistatic/events/staged_engine.hpp"
#include "support/analysis_bodies.hpp"
#include "support/reference_engine.hpp"

/// \file
/// Comparison of event engines with the reference.

namespace perilink::test {

/// Largest differences that round-off explains. Entries of a stiffness matrix have relative errors
/// of 1e-16, and the condition number of these bodies is up to 1e6 until they nearly separate;
/// displacements, and so load factors, have errors of 1e-10. Energies are products of two such
/// numbers and sums over events. Solves by conjugate gradients have errors of 1e-10 in the energy
/// norm.
struct Closeness {
  double load_factor = 1e-9, energy = 1e-8, residual = 1e-10;
};
inline constexpr Closeness of_gradients{1e-7, 1e-6, 1e-8};

/// Growth of the compliance after which a body counts as nearly separated: the condition number
/// grows as much.
inline constexpr double nearly_separated = 1e4;

/// Load factor over that of the first event above which the motion of pieces hides the stretches of
/// their bonds.
inline constexpr double far_motion = 100.0;

/// What a comparison has met.
struct Tally {
  int events = 0, broken = 0, yielded = 0, sides = 0, batches = 0, constant = 0, loose = 0;
  bool mechanism = false;
};

/// An engine of the comparison, with stages or without.
struct Compared {
  std::string name;
  std::unique_ptr<EventEngine> engine;
  Closeness close;
  StagedEngine* staged() const { return dynamic_cast<StagedEngine*>(engine.get()); }
};

/// Engines and the reference, event by event. All follow the events of the first engine. Loose
/// parts with closing bonds end the comparison: their position is the engine's choice.
class Comparison {
 public:
  Comparison(const LoadedNetwork& body, double tolerance)
      : body_(body), reference_(body, tolerance), tolerance_(tolerance) {
    first_ = size();
  }

  void add(std::string name, EquilibriumOptions options, Closeness close = {}) {
    options.event_tolerance = tolerance_;
    std::unique_ptr<EventEngine> engine;
    if (body_.sets.empty()) {
      engine = make_event_engine(body_, options);
    } else {
      engine = std::make_unique<StagedEngine>(body_, options);
    }
    compared_.push_back({std::move(name), std::move(engine), close});
    if (!body_.sets.empty()) {
      EXPECT_FALSE(compared_.back().staged()->open_for(1.0).mechanism);
    }
  }

  /// Follows up to `most` events of a body without load cases.
  void follow(int most) {
    expect_equal_states();
    while (tally_.events < most && pass({})) {
    }
  }

  /// Follows a stage: a load case moves to a load factor, or through some events.
  void follow_stage(std::size_t set, std::optional<double> to, int events) {
    if (is_over_) return;
    if (set != set_) {
      for (const Compared& each : compared_) {
        each.staged()->begin_stage(set, body_.sets[set].unknowns);
      }
      reference_.begin_stage(set);
      set_ = set;
      expect_equal_states();
    }
    const int end = tally_.events + events;
    while ((to || tally_.events < end) && pass(to)) {
    }
  }

  const Tally& tally() const { return tally_; }

 private:
  /// Compares the next event of all engines and applies it. \return whether the stage goes on
  bool pass(std::optional<double> to) {
    const ReferenceEvent expected =
        to ? reference_.next_event_towards(*to) : reference_.next_event();
    std::optional<Event> event;
    for (const Compared& each : compared_) {
      if (each.engine->load_work().separated) return end();
      Event own = to ? each.staged()->next_event_towards(*to) : each.engine->next_event();
      expect_equal_events(each, own, expected);
      if (!event) event = std::move(own);
    }
    if (testing::Test::HasFailure()) return end();
    direction_ = expected.direction;
    const bool arrived = event->element == no_index;
    if (arrived && !to) return end();
    if (!body_.sets.empty()) {
      for (const Compared& each : compared_)
        each.staged()->move_to(arrived ? *to : event->load_factor);
      // An extension is zero at the load factor of its own engine only.
      reference_.move_to(arrived               ? *to
                         : event->changes_side ? expected.load_factor
                                               : event->load_factor);
    }
    if (arrived) return false;
    std::vector<Index> elements = {event->element};
    elements.insert(elements.end(), event->others.begin(), event->others.end());
    return apply(*event, elements) || end();
  }

  bool end() {
    is_over_ = true;
    return false;
  }

  bool apply(const Event& event, const std::vector<Index>& elements) {
    const double before = size();
    EventOutcome own, turn;
    if (event.changes_side) {
      own = reference_.pass_side_change(direction_);
      ++tally_.sides;
    } else {
      std::optional<ReferenceEngine> in_turn;
      if (elements.size() > 1) in_turn.emplace(reference_);
      own = reference_.apply(elements);
      turn = in_turn ? in_turn->apply_in_turn(elements) : own;
      if (own.mechanism) own = turn;
      tally_.batches += in_turn.has_value();
    }
    tally_.mechanism = own.mechanism;
    tally_.constant += event.at_constant_load;
    tally_.loose += reference_.has_loose_parts();
    scale_ = std::max(before, size());
    const bool ends =
        own.mechanism || is_nearly_separated() || (tally_.loose > 0 && body_.network.has_closing());
    for (const Compared& each : compared_) {
      const EventOutcome outcome = each.engine->apply(event);
      // Engines count a body that hangs on elastic supports as separated.
      if (outcome.mechanism && !own.mechanism && hangs_on_supports(own, before)) return false;
      EXPECT_EQ(outcome.mechanism, own.mechanism) << row(each) << own.compliance_growth / before;
      if (!event.changes_side) {
        EXPECT_EQ(outcome.broken, own.broken) << row(each);
        EXPECT_EQ(outcome.yielded, own.yielded) << row(each);
      }
      if (!ends) expect_equal_outcomes(each, outcome, own, turn);
      if (outcome.exhausted != no_index) return false;
    }
    if (ends || testing::Test::HasFailure()) return false;
    ++tally_.events;
    tally_.broken += own.broken;
    tally_.yielded += own.yielded;
    expect_equal_states();
    return !testing::Test::HasFailure();
  }

  bool hangs_on_supports(const EventOutcome& own, double before) const {
    constexpr double least_support = 1e-2;
    return !body_.network.support_stiffness.empty() &&
           before < least_support * own.compliance_growth;
  }

  void expect_equal_states() {
    const LoadWork own = reference_.work();
    const double factor = reference_.load_factor();
    scale_ = size();
    const auto permanent = [&](const ConstantWork& terms) {
      return std::vector{terms.forces, factor * terms.forces_on_motion, terms.supports,
                         factor * terms.growing_forces, factor * terms.growing_supports};
    };
    const std::vector<double> own_terms = permanent(own.constant);
    double most = factor * factor * scale_;
    for (const double term : own_terms) most = std::max(most, std::abs(term));
    for (const Compared& each : compared_) {
      const LoadWork work = each.engine->load_work();
      expect_near(each, work.forces, own.forces, "work of forces");
      expect_near(each, work.supports, own.supports, "work of supports");
      const std::vector<double> terms = permanent(work.constant);
      for (std::size_t k = 0; k < terms.size(); ++k) {
        EXPECT_NEAR(terms[k], own_terms[k], each.close.energy * most) << row(each) << "term " << k;
      }
      expect_equal_motion(each);
      expect_equal_secants(each);
      if (tally_.events % 10 != 0) continue;  // the check refines displacements
      const double stored = each.engine->check_equilibrium().stored_energy;
      expect_near(each, stored, reference_.stored_energy(), "stored energy");
    }
  }

  std::string row(const Compared& each) const {
    return each.name + ", event " + std::to_string(tally_.events) + ": ";
  }

  /// Residuals are up to 1e-10 of the load of the intact body.
  void expect_near(const Compared& each, double value, double expected, const char* what) const {
    EXPECT_NEAR(value, expected, each.close.energy * scale_ + each.close.residual * first_)
        << row(each) << what;
  }

  double size() const {
    const LoadWork work = reference_.work();
    return work.forces + work.supports;
  }
  bool is_nearly_separated() const {
    return size() > nearly_separated * first_ || size() * nearly_separated < first_ ||
           largest_factor_ > far_motion * first_factor_;
  }

  void expect_equal_motion(const Compared& each) const {
    const std::span<const double> motion = each.engine->displacement();
    const Eigen::VectorXd own = body_.sets.empty()
                                    ? reference_.growing()
                                    : reference_.displacement_at(reference_.load_factor());
    const auto width = static_cast<std::size_t>(body_.network.width());
    double difference = 0.0;
    for (std::size_t slot = 0; slot < motion.size(); ++slot) {
      if (reference_.is_loose(static_cast<Index>(slot / width))) continue;
      difference = std::max(difference, std::abs(motion[slot] - own[static_cast<Index>(slot)]));
    }
    // Without load, round-off of the largest motion is left.
    const double largest = largest_factor_ * reference_.growing().cwiseAbs().maxCoeff();
    EXPECT_LE(difference, each.close.energy * own.cwiseAbs().maxCoeff() + 1e-12 * largest)
        << row(each);
  }

  void expect_equal_secants(const Compared& each) const {
    const Secants secants = each.engine->secants(), own = reference_.secants();
    for (Index e = 0; e < body_.network.num_elements(); ++e) {
      EXPECT_EQ(secants[e], own[e]) << row(each) << "element " << e;
      if (!reference_.has_side(e)) continue;
      EXPECT_EQ(secants.axial(e), own.axial(e)) << row(each) << "element " << e;
    }
  }

  /// The reference names every element that ties, within tie_tolerance and round-off. The engine
  /// chooses one of them.
  void expect_equal_events(const Compared& each, const Event& event,
                           const ReferenceEvent& expected) {
    ASSERT_EQ(event.element == no_index, expected.elements.empty())
        << row(each) << event.element << " at " << event.load_factor << ", now "
        << reference_.load_factor() << ", ratio "
        << reference_.ratio_at(event.load_factor, event.element);
    if (event.element == no_index) return;
    EXPECT_EQ(event.changes_side, expected.changes_side) << row(each);
    EXPECT_EQ(event.at_constant_load, expected.at_constant_load) << row(each);
    if (!event.changes_side) {
      EXPECT_TRUE(std::ranges::binary_search(expected.elements, event.element))
          << row(each) << "element " << event.element << ", not " << expected.elements.front();
    }
    double load_factor = expected.load_factor;
    if (!event.others.empty()) load_factor = middle_of(each, event, load_factor);
    largest_factor_ = std::max(largest_factor_, std::abs(load_factor));
    if (first_factor_ == 0.0) first_factor_ = std::abs(load_factor);
    EXPECT_NEAR(event.load_factor, load_factor, each.close.load_factor * largest_factor_)
        << row(each);
  }

  /// Checks that the elements of a batch are within the tolerance. \return its load factor
  double middle_of(const Compared& each, const Event& event, double first) const {
    const double noise = each.close.load_factor;
    if (!body_.sets.empty()) {
      const double least = 1.0 - (event.at_constant_load ? 0.0 : 0.5 * tolerance_) - noise;
      for (const Index other : event.others) {
        EXPECT_GE(reference_.ratio_at(event.load_factor, other), least) << row(each) << other;
      }
      return first;
    }
    double least = 1.0 / first;
    for (const Index other : event.others) least = std::min(least, reference_.ratio(other));
    EXPECT_GE(least * first, 1.0 - tolerance_ - noise) << row(each);
    return 2.0 / (1.0 / first + least);
  }

  /// \param turn  outcome if elements fail one by one: they release other energies
  void expect_equal_outcomes(const Compared& each, const EventOutcome& outcome,
                             const EventOutcome& own, const EventOutcome& turn) const {
    expect_near(each, outcome.compliance_growth, own.compliance_growth, "growth");
    const bool is_turn =
        std::abs(outcome.released - turn.released) < std::abs(outcome.released - own.released);
    expect_near(each, outcome.released, (is_turn ? turn : own).released, "released");
    const double factor = reference_.load_factor();
    const auto expect_near_at = [&](const Beside& value, const Beside& expected) {
      const double most = factor * factor * scale_ + std::abs(expected.at(factor));
      EXPECT_NEAR(value.at(factor), expected.at(factor), each.close.energy * most) << row(each);
    };
    expect_near_at(outcome.permanent_growth, own.permanent_growth);
    expect_near_at(outcome.released_by_permanent, (is_turn ? turn : own).released_by_permanent);
  }

  const LoadedNetwork& body_;
  ReferenceEngine reference_;
  std::vector<Compared> compared_;
  Tally tally_;
  double tolerance_, first_ = 1.0, scale_ = 1.0, first_factor_ = 0.0, largest_factor_ = 0.0,
                     direction_ = 1.0;
  std::size_t set_ = 0;
  bool is_over_ = false;
};

}  // namespace perilink::test
