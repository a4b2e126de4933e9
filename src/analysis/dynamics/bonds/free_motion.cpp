#include "analysis/dynamics/bonds/free_motion.hpp"

#include <cstddef>

namespace perilink {

MotionWork move_freely(const MotionStep& step, std::span<const double> load,
                       std::span<const double> inner, std::span<const double> mass,
                       std::span<double> velocity, std::span<double> displacement) {
  const double dt = step.time_step, factor = step.load_factor;
  const double keep = 1.0 / (1.0 + 0.5 * dt * step.damping_rate);
  const double lose = 1.0 - 0.5 * dt * step.damping_rate;
  const double *f = load.data(), *ku = inner.data(), *m = mass.data();
  double *v = velocity.data(), *u = displacement.data();
  double external = 0.0, damping = 0.0;
#pragma omp simd reduction(+ : external, damping)
  for (std::size_t slot = 0; slot < load.size(); ++slot) {
    const double applied = factor * f[slot];
    const double faster = keep * (lose * v[slot] + dt * (applied - ku[slot]) / m[slot]);
    const double twice = v[slot] + faster;
    external += applied * twice;
    damping += m[slot] * twice * twice;
    v[slot] = faster;
    u[slot] += dt * faster;
  }
  return {0.5 * dt * external, 0.25 * dt * step.damping_rate * damping};
}

}  // namespace perilink
