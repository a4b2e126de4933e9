#pragma once

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

using ExplicitObserver = RunObserver<ExplicitState>;

/// Runs a body from the given state by Euler–Cromer: forces at step n change velocities, and these
/// the displacements. Sums do not depend on the number of threads.
/// \throws std::invalid_argument where the time step exceeds the critical one (unless
///     refuse_unstable is off) or duration is not positive
/// \returns termination = failed where energy grows without external work: kinetic and stored
///          energy exceed twice all work done so far, or the kinetic energy exceeds it a hundred
///          times
ExplicitResult run_explicit_analysis(const ExplicitModel& model, ExplicitState& state,
                                     const ExplicitOptions& options, ExplicitObserver& observer);

}  // namespace perilink
