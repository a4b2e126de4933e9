#pragma once

#include "analysis/quasistatic/observer.hpp"

namespace perilink::verification {

/// Which bonds took the energy that a run dissipated [energy]. What is missing from the dissipated
/// energy snapped: a bond that falls to its next tooth is stretched farther at once.
struct Released {
  double broken = 0.0;    ///< bonds that broke
  double softened = 0.0;  ///< bonds that softened and hold
  double cut = 0.0;       ///< what all bonds across a plane take, the least of planes near the middle
};

/// \param middle  where along x the planes lie, one spacing to either side [length]
Released released_of(const StepState& state, double middle, double spacing);

}  // namespace perilink::verification
