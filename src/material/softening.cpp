#include "material/softening.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace perilink {
namespace {

/// Force at the end of an exponential curve.
constexpr double negligible_force = 1e-4;

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
  const bool knee = shape.kind == Softening::bilinear;
  return 1.0 + (end - 1.0) * (knee ? shape.knee_force + shape.knee_stretch : 1.0);
}

SofteningCurve::SofteningCurve(const SofteningShape& shape, double energy)
    : knee_(1.0), end_(energy), knee_force_(1.0), decay_(0.0) {
  if (shape.kind == Softening::brittle || !(energy > 1.0)) {
    throw std::invalid_argument("a softening bond must dissipate more than its elastic energy");
  }
  if (shape.kind == Softening::bilinear) {
    const double length = (energy - 1.0) / (shape.knee_force + shape.knee_stretch);
    end_ = 1.0 + length;
    knee_ = 1.0 + shape.knee_stretch * length;
    knee_force_ = shape.knee_force;
  } else if (shape.kind == Softening::concrete) {
    end_ = knee_ = 1.0 + 0.5 * (energy - 1.0);
  } else if (shape.kind == Softening::exponential) {
    decay_ = 0.5 * (energy - 1.0);
    end_ = 1.0 - decay_ * std::log(negligible_force);
  }
}

double SofteningCurve::force(double x) const {
  if (x <= 1.0) return x;
  if (x >= end_) return 0.0;
  if (decay_ > 0.0) return std::exp((1.0 - x) / decay_);
  return x < knee_ ? 1.0 - (1.0 - knee_force_) * (x - 1.0) / (knee_ - 1.0)
                   : knee_force_ * (end_ - x) / (end_ - knee_);
}

double SofteningCurve::area(double x) const {
  if (x <= 1.0) return 0.5 * x * x;
  // The area of an exponential curve beyond its end counts at its end.
  if (decay_ > 0.0) return 0.5 + decay_ * (x < end_ ? 1.0 - force(x) : 1.0);
  const bool drops = end_ == knee_ && x >= knee_;
  const double at_knee = drops ? knee_force_ : force(std::min(x, knee_));
  const double fallen = 0.5 * (std::min(x, knee_) - 1.0) * (1.0 + at_knee);
  if (x <= knee_) return 0.5 + fallen;
  const double reached = std::min(x, end_);
  return 0.5 + fallen + 0.5 * (reached - knee_) * (knee_force_ + force(reached));
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
