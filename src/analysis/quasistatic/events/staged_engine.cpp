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
      unknowns_(std::make_unique<Unknowns>(problem.unknowns)) {
  loads_.clamped_at.assign(problem.unknowns.prescribed.size(), 0.0);
  loads_.load_factors.assign(problem.sets.size(), 0.0);
  if (tolerance_ > 0.0) set_crossing_limits();
  begin_stage(0, *unknowns_);
}

StagedEngine::StagedEngine(const LoadedNetwork& problem, const EquilibriumOptions& options,
                           const Unknowns& held, const BodyState& saved)
    : SingleEventEngine(problem, options, &saved, &held),
      problem_(problem),
      crossings_(problem.network),
      last_crossing_threads_(options.threads),
      next_crossing_threads_(options.threads),
      unknowns_(std::make_unique<Unknowns>(held)),
      loads_(saved.loads) {
  for (const auto& [element, flow] : loads_.flow) {
    harden(element);
    set_limits(element);
  }
  set_crossing_limits();
  apply_loads();
  equilibrium_.go_on(saved.elements);
}

void StagedEngine::set_crossing_limits() {
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (network_.has_limit(e)) crossings_.set_limit(e, limit_of_crossings(e));
  }
}

/// Clamps the slots that a load case is the first to prescribe, at their present displacements.
void StagedEngine::clamped(std::size_t set, const Unknowns& held) {
  const std::span<const double> motion = displacement();
  for (std::size_t slot = 0; slot < motion.size(); ++slot) {
    const bool is_new = held.number[slot] == no_index && unknowns_->number[slot] != no_index;
    if (is_new) loads_.clamped_at[slot] = motion[slot];
  }
  follow_particles(problem_.network, loads_.clamped_at);
  *unknowns_ = held;
  loads_.newest = set;
}

bool StagedEngine::leave_flow() {
  const Network& network = problem_.network;
  const std::span<const double> motion = displacement();
  std::vector<Index> flown;
  for (Index e = network.first_bar_element; e < network.num_elements(); ++e) {
    const double secant = secants()[e];
    if (!network.is_embedded(e) || progress_.segments[e] == 0 || secant == 0.0) continue;
    const auto n = network.bonds.direction(e);
    const auto width = static_cast<std::size_t>(network.width());
    const std::size_t i = network.bonds.first[e] * width, j = network.bonds.second[e] * width;
    double extension = 0.0;
    for (std::size_t a = 0; a < n.size(); ++a) extension += n[a] * (motion[j + a] - motion[i + a]);
    const double plastic = (1.0 - secant) * extension;
    loads_.flowed.resize(motion.size(), 0.0);
    for (std::size_t a = 0; a < n.size(); ++a) loads_.flowed[j + a] -= plastic * n[a];
    loads_.flow[e] += std::abs(plastic) / network.bonds.length(e);
    progress_.segments[e] = 0;
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
  const ForceCurve rest = curve_behind(curve, loads_.flow[segment] / yield);
  own_laws_.insert_or_assign(
      segment, OwnLaw{perilink::law_of(rest, BondLaw::usual_ratio), yield * rest.points[0][0]});
}

void StagedEngine::begin_stage(std::size_t set, const Unknowns& held) {
  if (is_new(set)) clamped(set, held);
  loads_.load_factors[loads_.set] = loads_.load_factor;
  loads_.set = set;
  loads_.load_factor = loads_.load_factors[set];
  loads_.changes_there = 0;
  loads_.largest_factor = progress_.last_factor = 0.0;
  apply_loads();
}

/// Finds the equilibrium under the growing and the constant loads.
void StagedEngine::apply_loads() {
  ConstantLoads constant;
  constant.unknowns = *unknowns_;
  constant.unknowns.prescribed = loads_.clamped_at;
  for (std::size_t slot = 0; slot < loads_.flowed.size(); ++slot) {
    constant.unknowns.prescribed[slot] += loads_.flowed[slot];
  }
  constant.loads.forces.assign(problem_.loads.forces.size(), 0.0);
  constant.load_factor = loads_.load_factor;
  for (std::size_t other = 0; other < problem_.sets.size(); ++other) {
    const double factor = loads_.load_factors[other];
    if (other == loads_.set || factor == 0.0) continue;
    const LoadCase& loads = problem_.sets[other];
    for (std::size_t slot = 0; slot < loads_.clamped_at.size(); ++slot) {
      constant.loads.forces[slot] += factor * loads.loads.forces[slot];
      constant.unknowns.prescribed[slot] += factor * loads.unknowns.prescribed[slot];
    }
  }
  const LoadCase& growing = problem_.sets[loads_.set];
  unknowns_->prescribed = growing.unknowns.prescribed;
  equilibrium_.begin_stage(*unknowns_, growing.loads, std::move(constant));
}

void StagedEngine::move_to(double load_factor) {
  loads_.load_factor = load_factor;
  loads_.largest_factor = std::max(loads_.largest_factor, std::abs(load_factor));
  equilibrium_.move_to(load_factor);
}

std::span<const double> StagedEngine::displacement(std::span<const double> /*earlier*/,
                                                   Secants /*secants*/) {
  return displacement_at(loads_.load_factor);
}

std::span<const double> StagedEngine::displacement_at(double load_factor) {
  const std::span<const double> growing = equilibrium_.where_elements_fail();
  const std::span<const double> constant =
      equilibrium_.solution().permanent()->field().displacement;
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
      if (release_threshold_of(bond) < 1.0) return {bond, loads_.load_factor, true};
    }
    return with_others({worst().element, loads_.load_factor, true});
  }
  const double distance =
      last.element != no_index ? last.distance : std::numeric_limits<double>::infinity();
  if (const Event change = side_change_within(distance); change.element != no_index) {
    return turns_back(change) ? with_others({worst().element, loads_.load_factor, true}) : change;
  }
  if (last.element == no_index) return no_event();
  return with_others({last.element, loads_.load_factor + last.distance});
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
    const double growing = loads_.load_factor * loads_.load_factor * (work.forces + work.supports);
    limit_batch(event, growing + beside.at(loads_.load_factor), hits);
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
    return with_others({hit.element, loads_.load_factor, true});
  }
  CrossingSearch::Crossing next;
  next_crossing_threads_.run([&](int threads) {
    next = crossings_.ahead(now_, equilibrium_.where_elements_fail(),
                            target < loads_.load_factor ? -1 : 1, tie_tolerance, threads);
  });
  const bool reached =
      next.element != no_index && std::abs(next.distance) <= std::abs(target - loads_.load_factor);
  const double distance = reached ? next.distance : target - loads_.load_factor;
  if (const Event change = side_change_within(distance); change.element != no_index) return change;
  return reached ? with_others({next.element, loads_.load_factor + next.distance}) : Event{};
}

/// Returns the next contact state change of a damaged bond within a distance of the load factor.
Event StagedEngine::side_change_within(double distance) {
  if (!closes_ || distance == 0.0) return {};
  const Contact::Change change = equilibrium_.contact().next_change(distance);
  if (change.element == no_index) return {};
  loads_.direction = std::copysign(1.0, distance);
  return {change.element, loads_.load_factor + change.distance, false, true};
}

/// Returns whether bonds have just changed contact state here in the other direction. Elements
/// beyond their limits are then loaded more in both directions, so that no nearby load factor is
/// admissible.
bool StagedEngine::turns_back(const Event& change) {
  return loads_.has_changed_at(change.load_factor) && loads_.direction != loads_.changed_towards &&
         worst().ratio > 1.0 + tie_tolerance;
}

/// Counts contact state changes at one load factor, where all bonds should change together.
/// \throws SolverError after most_changes
void StagedEngine::count_changes() {
  constexpr int most_changes = 100;
  loads_.changes_there = loads_.has_changed_at(loads_.load_factor) ? loads_.changes_there + 1 : 1;
  loads_.changed_at = loads_.load_factor;
  loads_.changed_towards = loads_.direction;
  if (loads_.changes_there < most_changes) return;
  throw SolverError(fmt::format(
      "damaged bonds open and close again and again at the load factor {:.6g}: their contact "
      "states do not settle",
      loads_.load_factor));
}

EventOutcome StagedEngine::apply(const Event& event) {
  if (event.changes_side) {
    count_changes();
    return equilibrium_.pass_side_change(loads_.direction);
  }
  loads_.changes_there = 0;
  const EventOutcome outcome = SingleEventEngine::apply(event);
  if (outcome.mechanism) return outcome;
  crossings_.set_limit(event.element, limit_of_crossings(event.element));
  for (const Index other : event.others) crossings_.set_limit(other, limit_of_crossings(other));
  return outcome;
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
