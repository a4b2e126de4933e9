// Exhaustive search for the next event of the reference.

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/analysis_bodies.hpp"
#include "support/reference_engine.hpp"

namespace perilink::test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Axial stretch over the equivalent one, or over its limit, above which a bond that bends counts
/// as stretched [-] (LimitSearch and CrossingSearch).
constexpr double least_tension = 1e-6;

std::span<const double> view(const Eigen::VectorXd& motion) {
  return {motion.data(), static_cast<std::size_t>(motion.size())};
}

}  // namespace

double ReferenceEngine::limit_of(Index element) const {
  if (!network_.has_limit(element) || axial_[element] == 0.0) return never;
  const double limit = network_.law(element).segment(segments_[element]).limit;
  return threshold_[element] * network_.critical_stretch[element] * limit;
}

/// Returns the stretch over its limit up to which an element does not fail in a stage.
double ReferenceEngine::allowed(Index element) const {
  return network_.law(element).is_brittle() ? 1.0 : 1.0 + 0.5 * tolerance_;
}

double ReferenceEngine::extension(Index element, const Eigen::VectorXd& motion) const {
  return extension_of(network_, view(motion), element);
}

/// Returns the squared equivalent stretch times the length.
double ReferenceEngine::squared_stretch(Index element, const Eigen::VectorXd& motion) const {
  const bool axial = !is_frame(element) || network_.law(element).sense() == Sense::each;
  if (axial) return std::pow(extension(element, motion), 2);
  return 2.0 * element_energy(network_, view(motion), element) / network_.stiffness[element];
}

double ReferenceEngine::ratio(Index element, const Eigen::VectorXd& motion) const {
  const BondLaw& law = network_.law(element);
  const double length = network_.bonds.length(element), along = extension(element, motion);
  const double limit = limit_of(element) * length;
  const double stretch = std::sqrt(squared_stretch(element, motion));
  if (law.sense() == Sense::both) return stretch / limit;
  if (law.sense() == Sense::each) {
    const int segment = segments_[element];
    if (axial_[element] == 0.0) return 0.0;
    if (along > 0.0) return segment < 0 ? 0.0 : along / limit;
    const bool active =
        active_[network_.bonds.first[element]] + active_[network_.bonds.second[element]] > 0;
    if (segment > 0 || (segment == 0 && !active)) return 0.0;
    const double first = threshold_[element] * network_.critical_stretch[element] *
                         law.first_in_compression().limit * length;
    return -along / (segment == 0 ? first : limit);
  }
  // In a stage, round-off at the load factor where tension begins must not decide.
  const double least = body_.sets.empty() ? least_tension * stretch
                                          : (least_tension + tie) * allowed(element) * limit;
  return along > (is_frame(element) ? least : 0.0) ? stretch / limit : 0.0;
}

/// Returns the load factors at which an element reaches its limit, or a bond that bends becomes
/// stretched.
std::vector<double> ReferenceEngine::crossings(Index element) const {
  const double limit = allowed(element) * limit_of(element) * network_.bonds.length(element);
  if (!(limit < never)) return {};
  const double now = extension(element, constant_), rate = extension(element, growing_);
  std::vector<double> result;
  if (!is_frame(element)) {
    if (rate != 0.0) result = {(limit - now) / rate, (-limit - now) / rate};
    return result;
  }
  const double c = squared_stretch(element, constant_), p = squared_stretch(element, growing_);
  if (rate != 0.0) result.push_back((least_tension * limit - now) / rate);
  if (!(p > 0.0)) return result;
  const double size = c > 0.0 ? std::sqrt(c / p) : 1.0;
  const double mixed =
      (squared_stretch(element, constant_ + size * growing_) - c - size * size * p) / (2.0 * size);
  const double rest = mixed * mixed - p * (c - limit * limit);
  if (!(rest > 0.0)) return result;
  result.push_back((-mixed + std::sqrt(rest)) / p);
  result.push_back((-mixed - std::sqrt(rest)) / p);
  return result;
}

std::vector<double> ReferenceEngine::all_crossings() const {
  std::vector<double> all;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    for (const double load_factor : crossings(e)) all.push_back(load_factor);
  }
  std::ranges::sort(all);
  return all;
}

bool ReferenceEngine::is_admissible(double load_factor) const {
  const Eigen::VectorXd motion = displacement_at(load_factor);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (limit_of(e) < never && ratio(e, motion) > (1.0 + tie) * allowed(e)) return false;
  }
  return true;
}

/// Returns the elements with the largest ratio at the present load factor, or without load cases at
/// load factor 1.
ReferenceEvent ReferenceEngine::worst() const {
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  std::vector<double> ratios;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    ratios.push_back(limit_of(e) < never ? ratio(e, motion) : 0.0);
  }
  const double largest = *std::ranges::max_element(ratios);
  ReferenceEvent event{{}, load_factor_, true, false};
  for (Index e = 0; largest > 0.0 && e < network_.num_elements(); ++e) {
    if (ratios[e] >= (1.0 - tie) * largest) event.elements.push_back(e);
  }
  return event;
}

/// Returns the elements that fail beyond a load factor at which none fails.
ReferenceEvent ReferenceEngine::failing_at(double load_factor, double direction) const {
  ReferenceEvent event{{}, load_factor, false, false};
  for (Index e = 0; e < network_.num_elements(); ++e) {
    const double rate = std::sqrt(squared_stretch(e, growing_));
    if (!(limit_of(e) < never) || rate == 0.0) continue;
    const double step = direction * 1e-7 * limit_of(e) * network_.bonds.length(e) / rate;
    const double there = ratio_at(load_factor, e) / allowed(e);
    const double beyond = ratio_at(load_factor + step, e) / allowed(e);
    const double before = ratio_at(load_factor - step, e) / allowed(e);
    const bool reaches = there >= 1.0 - tie || there == 0.0;
    if (reaches && beyond > before && beyond >= 1.0 - tie) event.elements.push_back(e);
  }
  return event;
}

/// Returns the first contact state change before the end, or the event.
ReferenceEvent ReferenceEngine::or_side_change(ReferenceEvent event, double end) const {
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  double distance = std::abs(end - load_factor_);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (!can_close(e)) continue;
    const double rate = extension(e, growing_);
    const double growth = end > load_factor_ ? rate : -rate;
    const bool held = is_loose(network_.bonds.first[e]) || is_loose(network_.bonds.second[e]);
    if (!(is_closed(e) ? growth > 0.0 : growth < 0.0 && !held)) continue;
    const double change = -extension(e, motion) / rate;
    if (!(std::abs(change) < distance)) continue;
    distance = std::abs(change);
    event = {{e}, load_factor_ + change, false, true, end > load_factor_ ? 1.0 : -1.0};
  }
  return event;
}

ReferenceEvent ReferenceEngine::next_event() const {
  if (body_.sets.empty()) {
    ReferenceEvent event = worst();
    event.at_constant_load = false;
    if (!event.elements.empty()) event.load_factor = 1.0 / ratio(event.elements[0]);
    return event;
  }
  const std::vector<double> all = all_crossings();
  if (all.empty() || is_admissible(all.back() + std::abs(all.back()) + 1.0)) {
    return or_side_change({}, never);
  }
  const auto last = std::find_if(all.rbegin(), all.rend(),
                                 [&](double load_factor) { return is_admissible(load_factor); });
  return last == all.rend() ? worst() : or_side_change(failing_at(*last, 1.0), *last);
}

ReferenceEvent ReferenceEngine::next_event_towards(double target) const {
  if (!is_admissible(load_factor_)) return worst();
  const double direction = target < load_factor_ ? -1.0 : 1.0;
  std::vector<double> all = all_crossings();
  if (direction < 0.0) std::ranges::reverse(all);
  for (const double load_factor : all) {
    const double ahead = direction * (load_factor - load_factor_);
    if (ahead < -tie * std::abs(load_factor) || direction * (target - load_factor) < 0.0) continue;
    const ReferenceEvent event = failing_at(load_factor, direction);
    if (!event.elements.empty()) return or_side_change(event, load_factor);
  }
  return or_side_change({}, target);
}

}  // namespace perilink::test
