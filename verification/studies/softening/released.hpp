#pragma once

#include <limits>

#include "analysis/quasistatic/observer.hpp"

namespace perilink::verification {

/// Which bonds took the energy that a run dissipated [energy]. What is missing from the dissipated
/// energy snapped: a bond that falls to its next tooth is stretched farther at once.
struct Released {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double crack = unknown;   ///< bonds that have lost nine tenths of their stiffness, or broke
  double beside = unknown;  ///< all other bonds
  double cut =
      unknown;  ///< what bonds across a plane can take, the least of planes near the middle
};

/// \param middle  where along x the body has its middle, near which all bonds may soften [length]
Released released_of(const StepState& state, double middle, double spacing);

}  // namespace perilink::verification
