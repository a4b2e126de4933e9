#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Returns the stored energy of a row [force length], with products of the stretches of this step
/// and the last one in place of squares. The integrator conserves the sum of it and the kinetic
/// energy between the two steps, exactly for a linear body. Its decrease where factors fall or
/// plastic stretches grow is lost to motion. Effective stretches and sums must be up to date.
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double time_step);

/// Returns the kinetic energy of a row [force length].
double kinetic_energy(const ExplicitModel& model, const ExplicitState& state, Index row);

}  // namespace perilink
