#include "analysis/quasistatic/strain_watch.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {

StrainWatch::StrainWatch(const Network& network) : network_(network), most_shortening_(0.1) {
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.can_break(e)) continue;
    most_shortening_ = std::max(most_shortening_, 10.0 * network.critical_stretch[e]);
  }
}

bool StrainWatch::is_due(double load_factor) {
  const double size = std::abs(load_factor);
  if (looked_at_ > 0.0 && size < 2.0 * looked_at_) return false;
  looked_at_ = size;
  return true;
}

bool StrainWatch::is_beyond(std::span<const double> motion, double factor,
                            const Secants& secants) const {
  const auto width = static_cast<std::size_t>(network_.width());
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (!network_.can_break(e) || !(secants.axial(e) > 0.0)) continue;
    const double* const from = motion.data() + width * network_.bonds.first[e];
    const double* const to = motion.data() + width * network_.bonds.second[e];
    const std::span<const double> n = network_.bonds.direction(e);
    double extension = 0.0;
    for (int a = 0; a < network_.dim(); ++a) extension += n[a] * (to[a] - from[a]);
    if (factor * extension < -most_shortening_ * network_.bonds.lengths[e]) return true;
  }
  return false;
}

}  // namespace perilink
