#include "material/force_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace perilink {
namespace {

/// A curve that falls to zero ends at this fraction of its largest force; the last segment
/// dissipates the remaining area.
constexpr double negligible_end = 0.02;

/// Rise of secants due to round-off.
constexpr double round_off = 1e-12;

double secant_of(const std::array<double, 2>& point) { return point[1] / point[0]; }

/// Returns whether the force stays above zero after the last point.
bool stays(const ForceCurve& curve) { return curve.endless && curve.points.back()[1] > 0.0; }

/// Returns the largest deformation with at least the given secant.
double leaves_at(const ForceCurve& curve, double secant) {
  for (std::size_t k = 1; k < curve.points.size(); ++k) {
    const auto& [x, f] = curve.points[k];
    if (f / x >= secant) continue;
    const auto& [before, force] = curve.points[k - 1];
    const double slope = (f - force) / (x - before);
    return (force - slope * before) / (secant - slope);
  }
  return curve.points.back()[0];
}

/// Returns the last deformation with a segment of its own.
double end_of(const ForceCurve& curve) {
  double largest = 0.0;
  for (const auto& point : curve.points) largest = std::max(largest, point[1]);
  const auto& last = curve.points.back();
  if (stays(curve) || last[1] >= negligible_end * largest) return last[0];
  const auto& before = curve.points[curve.points.size() - 2];
  const double fall = std::max(before[1] - negligible_end * largest, 0.0);
  return before[0] + (last[0] - before[0]) * fall / (before[1] - last[1]);
}

}  // namespace

double ForceCurve::force(double deformation) const {
  if (deformation <= points.front()[0]) return initial_stiffness() * deformation;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (deformation > points[k][0]) continue;
    const double part = (deformation - points[k - 1][0]) / (points[k][0] - points[k - 1][0]);
    return points[k - 1][1] + part * (points[k][1] - points[k - 1][1]);
  }
  return endless ? points.back()[1] : 0.0;
}

double ForceCurve::area(double deformation) const {
  double area = 0.0, from = 0.0, lower = 0.0;
  for (const auto& point : points) {
    const double to = std::min(deformation, point[0]);
    if (to <= from) break;
    const double upper = to < point[0] ? force(to) : point[1];
    area += 0.5 * (lower + upper) * (to - from);
    from = to;
    lower = upper;
  }
  if (endless && deformation > from) area += lower * (deformation - from);
  return area;
}

ForceCurve curve_behind(const ForceCurve& curve, double flow) {
  ForceCurve rest;
  rest.endless = curve.endless;
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    const auto& [x, f] = curve.points[k];
    if (!(x - flow > f)) continue;  // points up to the elastic line are dropped
    if (rest.points.empty()) {
      const auto& [before, force] = curve.points[std::max<std::size_t>(k, 1) - 1];
      const double slope = (f - force) / (x - before);
      const double yield = (force + slope * (flow - before)) / (1.0 - slope);
      rest.points.push_back({yield, yield});
    }
    if (x - flow > rest.points.back()[0]) rest.points.push_back({x - flow, f});
  }
  if (rest.points.empty()) rest.points.push_back({curve.points.back()[1], curve.points.back()[1]});
  return rest;
}

void check_curve(const ForceCurve& curve) {
  std::array<double, 2> last = {0.0, 0.0};
  for (const auto& point : curve.points) {
    const bool first = last[0] == 0.0;
    if (!(point[0] > last[0])) throw std::invalid_argument("deformations must rise from zero");
    if (first ? !(point[1] > 0.0) : !(point[1] >= 0.0)) {
      throw std::invalid_argument("forces must be positive; only the last one may be zero");
    }
    if (!first && secant_of(point) > secant_of(last) * (1.0 + round_off)) {
      throw std::invalid_argument("force over deformation must not rise from point to point");
    }
    if (last[0] > 0.0 && last[1] == 0.0) {
      throw std::invalid_argument("no point may follow a force of zero");
    }
    last = point;
  }
  if (curve.points.empty()) throw std::invalid_argument("there are no points");
}

BondLaw law_of(const ForceCurve& curve, double ratio) {
  check_curve(curve);
  if (!(ratio > 1.0)) throw std::invalid_argument("the ratio of secants must be above one");
  const double stiffness = curve.initial_stiffness(), first = curve.points.front()[0];
  const double end = end_of(curve), last = curve.force(end) / end;
  const double fall = std::log(stiffness / last) / std::log(ratio);
  const int count = static_cast<int>(std::ceil(fall - round_off));
  std::vector<Segment> segments;
  double secant = stiffness, begin = first;
  const auto add = [&](double next_secant, double next, double taken) {
    const double energy = taken + 0.5 * (secant * begin * begin - next_secant * next * next);
    segments.push_back(
        {secant / stiffness, std::sqrt(2.0 * energy / (secant - next_secant)) / first});
    secant = next_secant;
    begin = next;
  };
  for (int k = 1; k <= count; ++k) {
    const double next =
        k == count ? last : stiffness * std::pow(last / stiffness, double(k) / count);
    const double at = k == count ? end : leaves_at(curve, next);
    add(next, at, curve.area(at) - curve.area(begin));
  }
  if (stays(curve)) {
    const double next = begin * ratio;
    add(secant / ratio, next, curve.points.back()[1] * (next - begin));
    return BondLaw::both_ways(std::move(segments), ratio);
  }
  add(0.0, begin, curve.area(curve.points.back()[0]) - curve.area(begin));
  return BondLaw::both_ways(std::move(segments), 0.0);
}

}  // namespace perilink
