#pragma once

#include <span>

namespace perilink {

/// Step of Euler–Cromer with mass-proportional damping.
struct MotionStep {
  double time_step = 0.0;
  double load_factor = 0.0;
  double damping_rate = 0.0;  ///< c [1/time]
};

/// Work during a step, with the mean of the old and the new velocity [force length].
struct MotionWork {
  double external = 0.0;
  double damping = 0.0;
};

/// Moves components of particles by a step, all spans of one length:
/// v+ = ((1 - c dt / 2) v + dt (factor load - inner) / mass) / (1 + c dt / 2), u+ = u + dt v+.
/// \param load   at a load factor of one [force]
/// \param inner  internal force K u [force]
MotionWork move_freely(const MotionStep& step, std::span<const double> load,
                       std::span<const double> inner, std::span<const double> mass,
                       std::span<double> velocity, std::span<double> displacement);

}  // namespace perilink
