#pragma once

#include "analysis/explicit_state.hpp"

namespace perilink {

/// Stored energy of a row, from its stretches and sums [force length].
double stored_energy(const ExplicitModel& model, const ExplicitState& state, Index row);

/// Stored energy of a row with the stretches of this step times those of the last one. The
/// integrator moves through each force for half a step on either side, so that this is what its
/// motion loses where factors fall or plastic stretches grow: exact for a linear body.
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double time_step);

}  // namespace perilink
