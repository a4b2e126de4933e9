#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Stored energy of a row with the stretches of this step times those of the last one
/// [force length]. What the integrator keeps, together with the kinetic energy of the velocities
/// between the two steps, and what its motion loses where factors fall or plastic stretches grow:
/// exact for a linear body. Effective stretches and sums must be up to date.
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double time_step);

}  // namespace perilink
