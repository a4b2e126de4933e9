#include "analysis/quasistatic/events/staged_engine.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace perilink {

StagedEngine::StagedEngine(const LoadedNetwork& problem, const EquilibriumOptions& options)
    : SingleEventEngine(problem, options),
      problem_(problem),
      crossings_(problem.network),
      last_crossing_threads_(options.threads),
      next_crossing_threads_(options.threads),
      unknowns_(std::make_unique<Unknowns>(problem.unknowns)),
      gripped_at_(problem.unknowns.prescribed.size(), 0.0),
      load_factors_(problem.sets.size(), 0.0) {
  for (Index e = 0; tolerance_ > 0.0 && e < network_.num_elements(); ++e) {
    if (network_.has_limit(e)) crossings_.set_limit(e, limit_of_crossings(e));
  }
  begin_stage(0, *unknowns_);
}

/// Clamps the slots that a load case is the first to prescribe, at their present displacements.
void StagedEngine::clamped(std::size_t set, const Unknowns& held) {
  const std::span<const double> motion = displacement();
  for (std::size_t slot = 0; slot < motion.size(); ++slot) {
    const bool is_new = held.number[slot] == no_index && unknowns_->number[slot] != no_index;
    if (is_new) gripped_at_[slot] = motion[slot];
  }
  follow_particles(problem_.network, gripped_at_);
  *unknowns_ = held;
  newest_ = set;
}

bool StagedEngine::leave_flow() {
  const Network& network = problem_.network;
  const std::span<const double> motion = displacement();
  std::vector<Index> flown;
  for (Index e = network.first_bar_element; e < network.num_elements(); ++e) {
    const double secant = secants()[e];
    if (!network.is_embedded(e) || segments_[e] == 0 || secant == 0.0) continue;
    const auto n = network.bonds.direction(e);
    const auto width = static_cast<std::size_t>(network.width());
    const std::size_t i = network.bonds.first[e] * width, j = network.bonds.second[e] * width;
    double extension = 0.0;
    for (std::size_t a = 0; a < n.size(); ++a) extension += n[a] * (motion[j + a] - motion[i + a]);
    const double plastic = (1.0 - secant) * extension;
    flowed_.resize(motion.size(), 0.0);
    for (std::size_t a = 0; a < n.size(); ++a) flowed_[j + a] -= plastic * n[a];
    flow_[e] += std::abs(plastic) / network.bonds.length(e);
    segments_[e] = 0;
    harden(e);
    flown.push_back(e);
  }
  equilibrium_.restore(flown);
  for (const Index e : flown) {
    set_limits(e);
    crossings_.set_limit(e, limit_of_crossings(e));
  }
  return !flown.empty();
}

/// Replaces the law of a bar that has flowed by the rest of its force curve.
void StagedEngine::harden(Index segment) {
  const Network& network = problem_.network;
  const Index bar = network.bars.bar[segment - network.first_bar_element];
  const ForceCurve& curve = network.bars.curves[bar];
  if (curve.points.empty()) return;  // a plateau
  const double yield = network.critical_stretch[segment];
  const ForceCurve rest = curve_behind(curve, flow_[segment] / yield);
  own_laws_.insert_or_assign(
      segment, OwnLaw{perilink::law_of(rest, BondLaw::usual_ratio), yield * rest.points[0][0]});
}

void StagedEngine::begin_stage(std::size_t set, const Unknowns& held) {
  if (is_new(set)) clamped(set, held);
  load_factors_[set_] = load_factor_;
  set_ = set;
  load_factor_ = load_factors_[set];
  changes_there_ = 0;
  largest_factor_ = last_factor_ = 0.0;
  ConstantField constant;
  constant.unknowns = *unknowns_;
  constant.unknowns.prescribed = gripped_at_;
  for (std::size_t slot = 0; slot < flowed_.size(); ++slot) {
    constant.unknowns.prescribed[slot] += flowed_[slot];
  }
  constant.loads.forces.assign(problem_.loads.forces.size(), 0.0);
  constant.load_factor = load_factor_;
  for (std::size_t other = 0; other < problem_.sets.size(); ++other) {
    const double factor = load_factors_[other];
    if (other == set || factor == 0.0) continue;
    const LoadCase& loads = problem_.sets[other];
    for (std::size_t slot = 0; slot < gripped_at_.size(); ++slot) {
      constant.loads.forces[slot] += factor * loads.loads.forces[slot];
      constant.unknowns.prescribed[slot] += factor * loads.unknowns.prescribed[slot];
    }
  }
  unknowns_->prescribed = problem_.sets[set].unknowns.prescribed;
  equilibrium_.begin_stage(*unknowns_, problem_.sets[set].loads, std::move(constant));
}

void StagedEngine::move_to(double load_factor) {
  load_factor_ = load_factor;
  largest_factor_ = std::max(largest_factor_, std::abs(load_factor));
  equilibrium_.move_to(load_factor);
}

std::span<const double> StagedEngine::displacement() { return displacement_at(load_factor_); }

std::span<const double> StagedEngine::displacement_at(double load_factor) {
  const std::span<const double> growing = equilibrium_.where_elements_fail();
  const std::span<const double> constant = equilibrium_.constant_displacement();
  now_.resize(growing.size());
  for (std::size_t slot = 0; slot < now_.size(); ++slot) {
    now_[slot] = constant[slot] + load_factor * growing[slot];
  }
  return now_;
}

BreakSearch::Hit StagedEngine::worst() {
  const std::span<const double> now = displacement();
  BreakSearch::Hit hit;
  threads_.run([&](int threads) { hit = search_->find(now, tie_tolerance, threads); });
  return hit;
}

Event StagedEngine::next_event_below(double /*most*/) {
  const std::span<const double> now = displacement();
  CrossingSearch::Crossing last;
  last_crossing_threads_.run([&](int threads) {
    last = crossings_.largest(now, equilibrium_.where_elements_fail(), tie_tolerance, threads);
  });
  if (last.element == no_index && !(last.distance > 0.0)) {
    for (const Index bond : last.conflict) {
      if (release_threshold_of(bond) < 1.0) return {bond, load_factor_, true};
    }
    return with_others({worst().element, load_factor_, true});
  }
  const double distance =
      last.element != no_index ? last.distance : std::numeric_limits<double>::infinity();
  if (const Event change = side_change_within(distance); change.element != no_index) {
    return turns_back(change) ? with_others({worst().element, load_factor_, true}) : change;
  }
  if (last.element == no_index) return {};
  return with_others({last.element, load_factor_ + last.distance});
}

/// Adds elements that fail with the event. They are within half of the tolerance of their limits at
/// its load factor. At a constant load, they are beyond their limits and within the tolerance of
/// the worst.
Event StagedEngine::with_others(Event event) {
  if (!fails_with_others(event.element)) return event;
  std::vector<BreakSearch::Hit> hits =
      near_hits(event, event.at_constant_load ? 1.0 : 1.0 - 0.5 * tolerance_);
  if (event.at_constant_load) {
    double worst = 0.0;
    for (const BreakSearch::Hit& hit : hits) worst = std::max(worst, hit.ratio);
    std::erase_if(
        hits, [&](const BreakSearch::Hit& hit) { return hit.ratio < (1.0 - tolerance_) * worst; });
  } else {
    const LoadWork work = load_work();
    const Beside beside{2.0 * (work.constant.forces_on_motion + work.constant.growing_supports),
                        work.constant.forces + work.constant.supports};
    const double growing = load_factor_ * load_factor_ * (work.forces + work.supports);
    limit_batch(event, growing + beside.at(load_factor_), hits);
  }
  for (const BreakSearch::Hit& hit : hits) {
    if (hit.element == event.element || !fails_with_others(hit.element)) continue;
    event.others.push_back(hit.element);
  }
  return event;
}

Event StagedEngine::next_event_towards(double target) {
  const BreakSearch::Hit hit = worst();
  const bool shares = hit.element != no_index && fails_with_others(hit.element);
  if (hit.ratio > 1.0 + (shares ? 0.5 * tolerance_ : 0.0) + tie_tolerance) {
    return with_others({hit.element, load_factor_, true});
  }
  CrossingSearch::Crossing next;
  next_crossing_threads_.run([&](int threads) {
    next = crossings_.ahead(now_, equilibrium_.where_elements_fail(),
                            target < load_factor_ ? -1 : 1, tie_tolerance, threads);
  });
  const bool reached =
      next.element != no_index && std::abs(next.distance) <= std::abs(target - load_factor_);
  const double distance = reached ? next.distance : target - load_factor_;
  if (const Event change = side_change_within(distance); change.element != no_index) return change;
  return reached ? with_others({next.element, load_factor_ + next.distance}) : Event{};
}

/// Returns the next contact state change of a damaged bond within a distance of the load factor.
Event StagedEngine::side_change_within(double distance) {
  if (!closes_ || distance == 0.0) return {};
  const Equilibrium::SideChange change = equilibrium_.next_side_change(distance);
  if (change.element == no_index) return {};
  direction_ = std::copysign(1.0, distance);
  return {change.element, load_factor_ + change.distance, false, true};
}

bool StagedEngine::is_last_change(double load_factor) const {
  constexpr double round_off = 1e-12;
  return changes_there_ > 0 && std::abs(load_factor - changed_at_) <= round_off * largest_factor_;
}

/// Returns whether bonds have just changed contact state here in the other direction. Elements
/// beyond their limits are then loaded more in both directions, so that no nearby load factor is
/// admissible.
bool StagedEngine::turns_back(const Event& change) {
  return is_last_change(change.load_factor) && direction_ != changed_towards_ &&
         worst().ratio > 1.0 + tie_tolerance;
}

/// Counts contact state changes at one load factor, where all bonds should change together.
/// \throws SolverError after most_changes
void StagedEngine::count_changes() {
  constexpr int most_changes = 100;
  changes_there_ = is_last_change(load_factor_) ? changes_there_ + 1 : 1;
  changed_at_ = load_factor_;
  changed_towards_ = direction_;
  if (changes_there_ < most_changes) return;
  throw SolverError(fmt::format(
      "damaged bonds open and close again and again at the load factor {:.6g}: their contact "
      "states do not settle",
      load_factor_));
}

EventOutcome StagedEngine::apply(const Event& event) {
  if (event.changes_side) {
    count_changes();
    return equilibrium_.pass_side_change(direction_);
  }
  changes_there_ = 0;
  const EventOutcome outcome = SingleEventEngine::apply(event);
  if (outcome.mechanism) return outcome;
  crossings_.set_limit(event.element, limit_of_crossings(event.element));
  for (const Index other : event.others) crossings_.set_limit(other, limit_of_crossings(other));
  return outcome;
}

LoadWork StagedEngine::load_work() {
  LoadWork work = equilibrium_.work();
  work.constant = equilibrium_.constant_work();
  return work;
}

Balance StagedEngine::check_equilibrium() {
  Balance balance = equilibrium_.check();
  equilibrium_.check_constant(balance);
  return balance;
}

Freedom StagedEngine::change_motion(const Unknowns& unknowns) {
  auto next = std::make_unique<Unknowns>(unknowns);
  next->prescribed = unknowns_->prescribed;
  const Freedom freedom = equilibrium_.change_motion(*next);
  unknowns_ = std::move(next);
  return freedom;
}

void StagedEngine::set_release_threshold(std::span<const Index> elements, double fraction) {
  SingleEventEngine::set_release_threshold(elements, fraction);
  for (const Index element : elements) crossings_.set_limit(element, limit_of_crossings(element));
}

std::vector<BreakSearch::Hit> StagedEngine::near_hits(const Event& event, double fraction) {
  return search_->list(displacement_at(event.load_factor), fraction);
}

}  // namespace perilink
