#pragma once

#include <vector>

#include "analysis/quasistatic/load_curve.hpp"

namespace perilink::verification {

/// Load of a curve at a displacement, along straight lines; that of its end beyond it [force].
inline double load_at(const std::vector<CurvePoint>& curve, double displacement) {
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const CurvePoint &a = curve[k - 1], &b = curve[k];
    if (b.displacement < displacement) continue;
    const double part = (displacement - a.displacement) / (b.displacement - a.displacement);
    return a.load + part * (b.load - a.load);
  }
  return curve.back().load;
}

}  // namespace perilink::verification
