#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace perilink {

/// What the steps of conjugate gradients have brought. Energies of two windows of steps one after
/// the other fall by a factor, and go on to. The slower the search, the longer the windows have to
/// be (docs/theory/large_bodies.md, L-2).
class EnergyGains {
 public:
  void add(double gain) { gains_.push_back(gain); }
  bool empty() const { return gains_.empty(); }
  /// Square root of the energy that was missing before the last window: its own and what a
  /// geometric series of windows adds behind it. Infinite before there are two.
  double error() const {
    const std::size_t window = std::max(shortest, gains_.size() / 8);
    if (gains_.size() < 2 * window) return std::numeric_limits<double>::infinity();
    const auto sum_to = [&](std::size_t end) {
      return std::accumulate(gains_.end() - static_cast<std::ptrdiff_t>(end + window),
                             gains_.end() - static_cast<std::ptrdiff_t>(end), 0.0);
    };
    const double last = sum_to(0), before = sum_to(window);
    const double ratio = before > 0.0 ? std::min(last / before, slowest) : 0.0;
    return std::sqrt(last / (1.0 - ratio));
  }

 private:
  static constexpr std::size_t shortest = 6;
  static constexpr double slowest = 0.999;
  std::vector<double> gains_;
};

}  // namespace perilink
