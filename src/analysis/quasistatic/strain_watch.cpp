#include "analysis/quasistatic/strain_watch.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {

bool StrainWatch::is_due(double motion) {
  constexpr int interval = 100;
  const double size = std::abs(motion);
  if (++events_ < interval && looked_at_ > 0.0 && size < due_at_) return false;
  looked_at_ = size;
  due_at_ = 2.0 * size;
  events_ = 0;
  return true;
}

bool StrainWatch::is_beyond(const Network& network, std::span<const double> motion, double factor,
                            const Secants& secants) {
  const auto width = static_cast<std::size_t>(network.width());
  double largest = 0.0;  // shortening over its limit
  for (Index e = 0; e < network.first_slip_spring; ++e) {
    if (!network.can_break(e) || network.law(e).crushes() || !(secants.axial(e) > 0.0)) continue;
    const double* const from = motion.data() + width * network.bonds.first[e];
    const double* const to = motion.data() + width * network.bonds.second[e];
    const std::span<const double> n = network.bonds.direction(e);
    double extension = 0.0;
    for (int a = 0; a < network.dim(); ++a) extension += n[a] * (to[a] - from[a]);
    const double most = std::max(0.1, 10.0 * network.critical_stretch[e]);
    largest = std::max(largest, -factor * extension / (most * network.bonds.length(e)));
  }
  if (largest > 0.5) due_at_ = looked_at_ / largest;
  return largest > 1.0;
}

}  // namespace perilink
