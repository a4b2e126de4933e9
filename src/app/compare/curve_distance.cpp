#include "app/compare/curve_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perilink {
namespace {

constexpr double no_distance = std::numeric_limits<double>::quiet_NaN();

/// Points per path for the mean over the arc length; their spacing is far below a line's width.
constexpr int samples = 1000;

double load_between(const CurvePoint& p, const CurvePoint& q, double displacement) {
  return p.load +
         (displacement - p.displacement) / (q.displacement - p.displacement) * (q.load - p.load);
}

/// Iterates over the intervals of a reading.
class Walker {
 public:
  explicit Walker(std::span<const CurvePoint> reading) : reading_(reading) {}
  /// Moves to the interval that begins at or before u and ends after u.
  void move_past(double u) {
    while (at_ + 2 < reading_.size() && reading_[at_ + 1].displacement <= u) ++at_;
  }
  double end() const { return reading_[at_ + 1].displacement; }
  double load(double u) const { return load_between(reading_[at_], reading_[at_ + 1], u); }

 private:
  std::span<const CurvePoint> reading_;
  std::size_t at_ = 0;
};

/// Integral of the square of a linear function from `low` to `high` over `width`.
double square_integral(double width, double low, double high) {
  return width / 3.0 * (low * low + low * high + high * high);
}

double length(const CurvePoint& p, const CurvePoint& q) {
  return std::hypot(q.displacement - p.displacement, q.load - p.load);
}

double square_distance(const CurvePoint& at, const CurvePoint& p, const CurvePoint& q) {
  const double du = q.displacement - p.displacement, dp = q.load - p.load;
  const double x = at.displacement - p.displacement, y = at.load - p.load;
  const double square = du * du + dp * dp;
  const double share = square > 0.0 ? std::clamp((x * du + y * dp) / square, 0.0, 1.0) : 0.0;
  const double across = x - share * du, along = y - share * dp;
  return across * across + along * along;
}

double distance_to(std::span<const CurvePoint> path, const CurvePoint& at) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    least = std::min(least, square_distance(at, path[k], path[k + 1]));
  }
  return std::sqrt(least);
}

double mean_distance(std::span<const CurvePoint> from, std::span<const CurvePoint> to) {
  double total = 0.0;
  for (std::size_t k = 0; k + 1 < from.size(); ++k) total += length(from[k], from[k + 1]);
  double sum = 0.0, begin = 0.0;
  std::size_t piece = 0;
  for (int s = 0; s < samples; ++s) {
    const double arc = total * (s + 0.5) / samples;
    double size = length(from[piece], from[piece + 1]);
    while (piece + 2 < from.size() && begin + size < arc) {
      begin += size;
      ++piece;
      size = length(from[piece], from[piece + 1]);
    }
    const double share = size > 0.0 ? std::min(1.0, (arc - begin) / size) : 0.0;
    const CurvePoint &p = from[piece], &q = from[piece + 1];
    sum += distance_to(to, {p.displacement + share * (q.displacement - p.displacement),
                            p.load + share * (q.load - p.load)});
  }
  return sum / samples;
}

std::vector<CurvePoint> scaled(std::span<const CurvePoint> path, CurvePoint largest) {
  std::vector<CurvePoint> result;
  result.reserve(path.size());
  for (const CurvePoint& p : path) {
    result.push_back({p.displacement / largest.displacement, p.load / largest.load});
  }
  return result;
}

}  // namespace

std::vector<CurvePoint> path_of(std::span<const StepRecord> records) {
  std::vector<CurvePoint> path = points_of(records);
  path.insert(path.begin(), CurvePoint{});
  const auto [low, high] = std::ranges::minmax(path, {}, &CurvePoint::displacement);
  const double sign = -low.displacement > high.displacement ? -1.0 : 1.0;
  for (CurvePoint& point : path) point = {sign * point.displacement, sign * point.load};
  return path;
}

std::vector<CurvePoint> displacement_reading(std::span<const CurvePoint> path) {
  std::vector<CurvePoint> reading = {path.front()};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const CurvePoint &p = path[k - 1], &q = path[k];
    const double reached = reading.back().displacement;
    if (q.displacement <= reached) continue;
    const double load = load_between(p, q, reached);
    if (load != reading.back().load) reading.push_back({reached, load});
    reading.push_back(q);
  }
  return reading;
}

double load_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b, double range) {
  if (a.size() < 2 || b.size() < 2 || !(range > 0.0)) return no_distance;
  Walker in_a(a), in_b(b);
  double difference = 0.0, reference = 0.0;
  for (double low = 0.0; low < range;) {
    in_a.move_past(low);
    in_b.move_past(low);
    const double high = std::min({in_a.end(), in_b.end(), range});
    if (!(high > low)) break;
    const double a_low = in_a.load(low), a_high = in_a.load(high);
    difference += square_integral(high - low, in_b.load(low) - a_low, in_b.load(high) - a_high);
    reference += square_integral(high - low, a_low, a_high);
    low = high;
  }
  return reference > 0.0 ? std::sqrt(difference / reference) : no_distance;
}

double work_until(std::span<const CurvePoint> reading, double range) {
  double work = 0.0;
  for (std::size_t k = 0; k + 1 < reading.size(); ++k) {
    const CurvePoint &p = reading[k], &q = reading[k + 1];
    if (p.displacement >= range) break;
    if (!(q.displacement > p.displacement)) continue;
    const double high = std::min(q.displacement, range);
    work += 0.5 * (high - p.displacement) * (p.load + load_between(p, q, high));
  }
  return work;
}

double path_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b) {
  if (a.size() < 2 || b.size() < 2) return no_distance;
  CurvePoint largest;
  for (const std::span<const CurvePoint> path : {a, b}) {
    for (const CurvePoint& p : path) {
      largest.displacement = std::max(largest.displacement, std::abs(p.displacement));
      largest.load = std::max(largest.load, std::abs(p.load));
    }
  }
  if (!(largest.displacement > 0.0) || !(largest.load > 0.0)) return no_distance;
  const std::vector<CurvePoint> scaled_a = scaled(a, largest), scaled_b = scaled(b, largest);
  return 0.5 * (mean_distance(scaled_a, scaled_b) + mean_distance(scaled_b, scaled_a));
}

}  // namespace perilink
