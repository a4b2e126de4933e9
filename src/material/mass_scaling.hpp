#pragma once

namespace perilink {

/// Distribution of masses among particles.
enum class MassScaling {
  none,     ///< density times volume
  uniform,  ///< proportional to the stiffness around the particle; single short bonds then do not
            ///< limit the time step. The mass of the whole body is unchanged. Only for runs to
            ///< static equilibrium, since wave speeds are wrong
};

}  // namespace perilink
