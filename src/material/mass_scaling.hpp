#pragma once

namespace perilink {

/// How masses are shared among particles.
enum class MassScaling {
  none,     ///< density times volume
  uniform,  ///< in proportion to the stiffness around the particle, so that single short bonds do
            ///< not rule the time step; the mass of the whole body is the same. For runs to an
            ///< equilibrium only: waves are not those of the material
};

}  // namespace perilink
