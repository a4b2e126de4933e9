#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"
#include "assembly/linear_elements.hpp"
#include "base/block.hpp"
#include "base/error.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

struct NoisyExtension {
  double value;      ///< [length]
  double round_off;  ///< from the motions of the two ends [length]
};

NoisyExtension extension_of(const Network& network, Index element, std::span<const double> u) {
  const std::span<const double> n = network.bonds.direction(element);
  const std::size_t i = static_cast<std::size_t>(network.bonds.first[element]) * network.width();
  const std::size_t j = static_cast<std::size_t>(network.bonds.second[element]) * network.width();
  NoisyExtension change{0.0, 0.0};
  for (int a = 0; a < network.dim(); ++a) {
    change.value += n[a] * (u[j + a] - u[i + a]);
    change.round_off +=
        motion_round_off * std::abs(n[a]) * (std::abs(u[j + a]) + std::abs(u[i + a]));
  }
  return change;
}

}  // namespace

SingleEventEngine::SingleEventEngine(const LoadedNetwork& problem,
                                     const EquilibriumOptions& options, const BodyState* saved,
                                     const Unknowns* unknowns)
    : network_(problem.network),
      threads_(options.threads),
      tolerance_(options.event_tolerance),
      equilibrium_(problem, options, unknowns, saved != nullptr ? &saved->elements : nullptr),
      search_(make_break_search(network_, !problem.sets.empty())),
      closes_(network_.has_closing()) {
  if (network_.has_crushing()) crushing_.emplace(network_);
  progress_.segments.resize(static_cast<std::size_t>(network_.num_elements()), 0);
  if (saved == nullptr) return;
  progress_ = saved->progress;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (progress_.segments[e] != 0) set_limits(e);
  }
}

Event SingleEventEngine::next_event_below(double most) {
  const auto find = [&] {
    const std::span<const double> displacement = equilibrium_.where_elements_fail();
    BreakSearch::Hit hit;
    threads_.run([&](int threads) { hit = search_->find(displacement, tie_tolerance, threads); });
    return hit;
  };
  BreakSearch::Hit hit = find();
  const Solution& solution = equilibrium_.solution();
  // The extension of the element may be noise, or round-off of the motion of its ends. No element
  // is then in tension, and the load factor would be meaningless.
  const auto is_within = [&](double noise) {
    if (network_.carries_moments()) {  // the search includes shear and bending
      return hit.ratio * limit_of(hit.element) * network_.bonds.length(hit.element) <= noise;
    }
    const NoisyExtension change =
        extension_of(network_, hit.element, equilibrium_.where_elements_fail());
    return std::abs(change.value) <= change.round_off + noise;
  };
  const double noise = solution.noise(), noise_of_events = solution.noise_of_events();
  if (hit.element != no_index && noise_of_events > noise && is_within(noise_of_events)) {
    equilibrium_.check();
    hit = find();
  }
  if (hit.element == no_index || is_within(noise)) return no_event(hit);
  constexpr double far = 1e-6;  // other events need no look at all displacements
  double& before = progress_.largest_ratio;
  if (hit.ratio <= far * before || before == 0.0) {
    const double largest = largest_displacement(network_, equilibrium_.where_elements_fail());
    if (is_within(motion_round_off * largest)) return no_event(hit);
  }
  before = std::max(before, hit.ratio);
  Event event{hit.element, 1.0 / hit.ratio};
  if (fails_with_others(hit.element) && event.load_factor <= most) {
    add_others(event, hit.ratio, most);
  }
  return event;
}

/// Adds elements whose load factors lie within the tolerance of the event and below the step. The
/// event moves to the middle of their load factors.
/// \param ratio  stretch of the event's element over its limit, at load factor 1
/// \param most   load factor of the step
void SingleEventEngine::add_others(Event& event, double ratio, double most) {
  const double wanted = std::max((1.0 - tolerance_) * ratio, 1.0 / most);
  std::vector<BreakSearch::Hit> hits = search_->list(equilibrium_.where_elements_fail(), wanted);
  const LoadWork work = equilibrium_.work();
  limit_batch(event, work.forces + work.supports, hits);
  double least = ratio;
  for (const BreakSearch::Hit& hit : hits) {
    if (hit.element == event.element || !fails_with_others(hit.element)) continue;
    event.others.push_back(hit.element);
    least = std::min(least, hit.ratio);
  }
  event.load_factor = std::min(2.0 / (ratio + least), most);
}

/// Limits a batch, since a running crack also unloads elements that are about to fail. The batch
/// ends where its energy loss would lower the load by half of the tolerance. The size is halved if
/// the load fell by over a quarter of the tolerance since the last batch.
/// \param energy  twice the energy of the body, at load factor 1 or at the present one of a stage
/// \param hits    sorted by falling ratio on return
void SingleEventEngine::limit_batch(const Event& event, double energy,
                                    std::vector<BreakSearch::Hit>& hits) {
  constexpr double most_lost = 0.5, most_fall = 0.25, growth = 1.5;
  const double factor = std::abs(event.load_factor);
  const bool fell = factor < (1.0 - most_fall * tolerance_) * progress_.last_factor;
  progress_.most_at_once =
      fell ? std::max(1.0, 0.5 * progress_.last_count) : growth * progress_.most_at_once;
  double left = most_lost * tolerance_ * energy;
  std::ranges::stable_sort(hits, std::greater(), &BreakSearch::Hit::ratio);
  // Ties are sorted by number, since their last digits are round-off.
  for (auto begin = hits.begin(); begin != hits.end();) {
    const double least = (1.0 - tie_tolerance) * begin->ratio;
    const auto end = std::find_if(begin, hits.end(),
                                  [&](const BreakSearch::Hit& hit) { return hit.ratio < least; });
    std::ranges::sort(begin, end, std::less(), &BreakSearch::Hit::element);
    begin = end;
  }
  std::size_t count = 0;
  for (; count < hits.size() && static_cast<double>(count) < progress_.most_at_once; ++count) {
    const Index element = hits[count].element;
    if (!fails_with_others(element)) continue;
    left -= energy_lost(equilibrium_.solution(),
                        {element, law_of(element).segment(next_segment(element)).secant});
    if (left < 0.0) break;
  }
  // Round-off may have left `hits` empty.
  hits.resize(std::min(hits.size(), std::max<std::size_t>(count, 1)));
  progress_.last_count = std::max(1.0, static_cast<double>(hits.size()));
  progress_.last_factor = factor;
}

/// No element is in tension, which is so if other elements are strained far more. If none is, the
/// pieces of a damaged body move as wholes. In an undamaged body weak springs let the body move,
/// and round-off hides its strains.
Event SingleEventEngine::no_event(const BreakSearch::Hit& reached) {
  constexpr double far_more = 1e3;
  const std::span<const double> motion = equilibrium_.displacement();
  const double noise = motion_round_off * largest_displacement(network_, motion);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (secants()[e] == 0.0) continue;
    const NoisyExtension change = extension_of(network_, e, motion);
    double size = std::abs(change.value);
    if (network_.carries_moments()) {
      const Removal modes = removal_of(equilibrium_.solution(), {e, 0.0});
      const double energy = square_of(deformations(equilibrium_.solution(), modes, e));
      size = std::sqrt(energy / (secants().axial(e) * network_.stiffness[e]));
    }
    // Elements without a limit compare with the strain reached.
    const Index like = network_.has_limit(e) ? e : reached.element;
    const double most = reached.element == no_index || reached.ratio == 0.0
                            ? 0.0
                            : reached.ratio * limit_of(like) * network_.bonds.length(e);
    if (size - change.round_off - noise > far_more * most) return {};
  }
  if (network_.cells) {
    const auto [work, sizes] = work_between(*network_.cells, network_.width(), motion, motion);
    if (work > motion_round_off * sizes) return {};
  }
  const auto is_intact = [](int segment) { return segment == 0; };
  const bool intact = std::ranges::all_of(progress_.segments, is_intact);
  if (!intact || reached.element == no_index) return {.no_strain = !intact};
  throw SolverError(
      "the body moves as a whole, so far that round-off hides the stretches of its bonds: the "
      "next bond to break is unknown; hold the body by supports or by stiffer springs");
}

/// Solves for missing columns of K^-1 of an event, with columns of the elements closest to their
/// events.
void SingleEventEngine::prepare(const Event& event) {
  if (equilibrium_.update().is_prepared(event.element)) return;
  constexpr double near = 0.5;
  std::vector<BreakSearch::Hit> hits = near_hits(event, near);
  std::ranges::stable_sort(hits, std::greater(), &BreakSearch::Hit::ratio);
  std::vector<Index> expected;
  for (const BreakSearch::Hit& hit : hits) {
    if (expected.size() == block_width - 1) break;
    if (!equilibrium_.update().is_prepared(hit.element)) expected.push_back(hit.element);
  }
  equilibrium_.prepare(event.element, expected);
}

EventOutcome SingleEventEngine::apply(const Event& event) {
  const bool alone = event.others.empty() && !equilibrium_.update().searches();
  if (alone || !fails_with_others(event.element)) return apply_one(event);
  std::vector<Index> elements = {event.element};
  elements.insert(elements.end(), event.others.begin(), event.others.end());
  return apply_all(elements, event.load_factor);
}

EventOutcome SingleEventEngine::apply_one(const Event& event) {
  prepare(event);
  const int next = next_segment(event.element);
  EventOutcome outcome =
      equilibrium_.weaken(event.element, law_of(event.element).segment(next).secant);
  if (outcome.mechanism) {
    outcome.broken = outcome.broke() ? 1 : 0;
    outcome.separating = event.element;
    return outcome;
  }
  pass_limit(event.element, next, outcome);
  return outcome;
}

/// Weakens a batch. If that may separate the body, its elements fail one by one, or half of them
/// first if no factor makes single events cheap.
EventOutcome SingleEventEngine::apply_all(std::span<const Index> elements, double load_factor) {
  std::vector<int> segments;
  std::vector<Weakening> changes;
  for (const Index element : elements) {
    segments.push_back(next_segment(element));
    changes.push_back({element, law_of(element).segment(segments.back()).secant});
  }
  if (auto outcome = equilibrium_.weaken_together(changes)) {
    for (std::size_t k = 0; k < elements.size(); ++k)
      pass_limit(elements[k], segments[k], *outcome);
    return *outcome;
  }
  if (elements.size() == 1) return apply_one({elements[0], load_factor});
  const std::size_t part = equilibrium_.update().searches() ? elements.size() / 2 : 1;
  EventOutcome outcome;
  for (std::size_t begin = 0; begin < elements.size() && !outcome.mechanism; begin += part) {
    const auto some = elements.subspan(begin, std::min(part, elements.size() - begin));
    outcome.add(part == 1 ? apply_one({some[0], load_factor}) : apply_all(some, load_factor));
  }
  return outcome;
}

int SingleEventEngine::next_segment(Index element) const {
  const bool compressed = law_of(element).crushes() &&
                          is_shorter(network_, element, equilibrium_.where_elements_fail());
  return BondLaw::after(progress_.segments[element], compressed);
}

void SingleEventEngine::pass_limit(Index element, int segment, EventOutcome& outcome) {
  const double secant = law_of(element).segment(segment).secant;
  progress_.segments[element] = segment;
  set_limits(element);
  ++(secant == 0.0 ? outcome.broken : outcome.yielded);
  if (network_.law(element).is_exhausted(secant)) outcome.exhausted = element;
}

void SingleEventEngine::set_limits(Index element) {
  const double limit = limit_of(element);
  if (!network_.law(element).crushes()) return search_->set_limit(element, limit);
  const int segment = progress_.segments[element];
  constexpr double none = std::numeric_limits<double>::infinity();
  double tension = segment >= 0 ? limit : none, compression = segment >= 0 ? none : limit;
  if (segment == 0 && secants()[element] > 0.0 && crushing_->is_active(element)) {
    compression = release_threshold_of(element) * network_.critical_stretch[element] *
                  network_.law(element).first_in_compression().limit;
  }
  search_->set_limits(element, tension, compression);
  if (segment < 1) return;
  for (const Index woken : crushing_->wake(element)) {
    if (progress_.segments[woken] == 0 && secants()[woken] > 0.0) set_limits(woken);
  }
}

double SingleEventEngine::limit_of(Index element) const {
  const Segment segment = law_of(element).segment(progress_.segments[element]);
  if (segment.secant == 0.0) return std::numeric_limits<double>::infinity();
  return release_threshold_of(element) * stretch_of(element) * segment.limit;
}

const BondLaw& SingleEventEngine::law_of(Index element) const {
  const auto own = own_laws_.find(element);
  return own == own_laws_.end() ? network_.law(element) : own->second.law;
}

double SingleEventEngine::stretch_of(Index element) const {
  const auto own = own_laws_.find(element);
  return own == own_laws_.end() ? network_.critical_stretch[element] : own->second.stretch;
}

void SingleEventEngine::set_release_threshold(std::span<const Index> elements, double fraction) {
  release_threshold_.resize(progress_.segments.size(), 1.0);
  for (const Index element : elements) {
    if (!network_.has_limit(element) || secants()[element] == 0.0) continue;
    release_threshold_[element] = fraction;
    set_limits(element);
  }
}

std::vector<Index> SingleEventEngine::near_events(const Event& event, double fraction) {
  std::vector<Index> elements;
  for (const BreakSearch::Hit& hit : near_hits(event, fraction)) elements.push_back(hit.element);
  return elements;
}

std::vector<BreakSearch::Hit> SingleEventEngine::near_hits(const Event& event, double fraction) {
  return search_->list(equilibrium_.where_elements_fail(), fraction / event.load_factor);
}

int SingleEventEngine::cut(std::span<const Index> elements) {
  int springs = 0;
  for (const Index element : elements) {
    springs += equilibrium_.cut(element);
    search_->set_limit(element, std::numeric_limits<double>::infinity());
  }
  return springs;
}

}  // namespace perilink
