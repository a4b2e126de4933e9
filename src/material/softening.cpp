#include "material/softening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace perilink {
namespace {

/// Force at the end of an exponential curve.
constexpr double negligible_force = 1e-4;

using Point = std::array<double, 2>;

/// Returns the points of a shape of straight lines between its ends, as SofteningShape::points.
std::vector<Point> inner_points(const SofteningShape& shape) {
  if (shape.kind == Softening::bilinear) return {{shape.knee_stretch, shape.knee_force}};
  return shape.kind == Softening::points ? shape.points : std::vector<Point>();
}

/// Returns twice the area below the lines from (0, 1) through some points to (1, 0).
double twice_the_area(const std::vector<Point>& points) {
  double sum = points.empty() ? 1.0 : points.back()[1];
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double before = k == 0 ? 1.0 : points[k - 1][1];
    const double after = k + 1 == points.size() ? 0.0 : points[k + 1][1];
    sum += points[k][0] * (before - after);
  }
  return sum;
}

/// A segment that leaves the curve at two points.
struct SegmentBetween {
  double secant, next_secant, limit;

  SegmentBetween(const SofteningCurve& curve, double begin, double end)
      : secant(curve.force(begin) / begin), next_secant(curve.force(end) / end) {
    const double energy = curve.area(end) - curve.area(begin) +
                          0.5 * (secant * begin * begin - next_secant * end * end);
    limit = std::sqrt(2.0 * energy / (secant - next_secant));
  }
  double overshoot(const SofteningCurve& curve) const {
    return secant * limit - curve.force(limit);
  }
};

}  // namespace

double softening_energy(const SofteningShape& shape, double end) {
  if (shape.kind == Softening::concrete) return 1.0 + 2.0 * (end - 1.0);
  return 1.0 + (end - 1.0) * twice_the_area(inner_points(shape));
}

SofteningCurve::SofteningCurve(const SofteningShape& shape, double energy)
    : corners_{{1.0, 1.0}}, end_(energy) {
  if (shape.kind == Softening::brittle || !(energy > 1.0)) {
    throw std::invalid_argument("a softening bond must dissipate more than its elastic energy");
  }
  if (shape.kind == Softening::exponential) {
    decay_ = 0.5 * (energy - 1.0);
    end_ = 1.0 - decay_ * std::log(negligible_force);
    return;
  }
  if (shape.kind == Softening::concrete) {
    end_ = 1.0 + 0.5 * (energy - 1.0);
    corners_.push_back({end_, 1.0});
  }
  const std::vector<Point> inner = inner_points(shape);
  if (!inner.empty()) {
    const double length = (energy - 1.0) / twice_the_area(inner);
    end_ = 1.0 + length;
    for (const auto& [x, force] : inner) corners_.push_back({1.0 + x * length, force});
  }
  corners_.push_back({end_, 0.0});
}

double SofteningCurve::force(double x) const {
  if (x <= 1.0) return x;
  if (x >= end_) return 0.0;
  if (decay_ > 0.0) return std::exp((1.0 - x) / decay_);
  const auto after = std::find_if(corners_.begin() + 1, corners_.end(),
                                  [x](const auto& corner) { return x < corner[0]; });
  const auto& [begin, first] = *(after - 1);
  const auto& [end, last] = *after;
  if (last == 0.0) return first * (end - x) / (end - begin);
  return first - (first - last) * (x - begin) / (end - begin);
}

double SofteningCurve::area(double x) const {
  if (x <= 1.0) return 0.5 * x * x;
  // The area of an exponential curve beyond its end counts at its end.
  if (decay_ > 0.0) return 0.5 + decay_ * (x < end_ ? 1.0 - force(x) : 1.0);
  double sum = 0.5;
  for (std::size_t k = 1; k < corners_.size() && corners_[k - 1][0] < x; ++k) {
    const auto& [begin, first] = corners_[k - 1];
    const auto& [end, last] = corners_[k];
    const bool falls_at_once = k + 1 < corners_.size() && corners_[k + 1][0] == end;
    const double reached = std::min(x, end);
    const double at_end = falls_at_once && reached == end ? last : force(reached);
    sum += 0.5 * (reached - begin) * (first + at_end);
  }
  return sum;
}

std::vector<Segment> segments_of(const SofteningCurve& curve, double overshoot) {
  if (!(overshoot > 0.0))
    throw std::invalid_argument("the overshoot of saw-tooth segments must be positive");
  std::vector<Segment> segments;
  for (double begin = 1.0; begin < curve.end();) {
    double low = begin, end = curve.end();
    const auto rises_less = [&](double point) {
      return SegmentBetween(curve, begin, point).overshoot(curve) <= overshoot;
    };
    if (!rises_less(end)) {
      for (double high = end; high - low > 1e-12 * high;) {
        end = 0.5 * (low + high);
        (rises_less(end) ? low : high) = end;
      }
    }
    const SegmentBetween segment(curve, begin, end);
    if (!(segment.limit >= begin &&
          std::isfinite(segment.limit))) {  // otherwise the loop would not end
      throw std::invalid_argument("the curve is too flat for saw-tooth segments");
    }
    segments.push_back({segment.secant, segment.limit});
    begin = end;
  }
  return segments;
}

BondLaw saw_tooth_of(const SofteningCurve& curve, double overshoot) {
  return BondLaw::saw_tooth(segments_of(curve, overshoot));
}

}  // namespace perilink
