#pragma once

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

using ExplicitObserver = RunObserver<ExplicitState>;

/// Runs a body from the given state by Euler–Cromer: forces at step n change velocities, and these
/// the displacements. Sums do not depend on the number of threads.
/// \param from  state in which a run of this model and these options was saved; `state` then starts
///              as constructed. Null: the run starts at step zero
/// \throws std::invalid_argument where the time step exceeds the critical one (unless
///     refuse_unstable is off), duration is not positive, or `from` is of another body or run
/// \returns termination = failed where energy grows without external work: kinetic and stored
///          energy exceed twice all work done so far, or the kinetic energy exceeds it a hundred
///          times
ExplicitResult run_explicit_analysis(const ExplicitModel& model, ExplicitState& state,
                                     const ExplicitOptions& options, ExplicitObserver& observer,
                                     const TimeState* from = nullptr);

}  // namespace perilink
