#pragma once

#include <memory>

#include "solver/ranks.hpp"

namespace perilink {

/// The processes that mpiexec has started, by PETSc over MPI; one per process, to be made first and
/// destroyed last. PETSc takes its own options from PETSC_OPTIONS alone.
/// \throws SolverError where MPI does not start
std::unique_ptr<Ranks> start_petsc_ranks();

}  // namespace perilink
