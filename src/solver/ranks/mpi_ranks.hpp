#pragma once

#include <memory>

#include "solver/ranks.hpp"

namespace perilink {

/// Starts MPI and returns the communicator of all processes of mpiexec. Call it first in a process,
/// and destroy the result last.
/// \throws SolverError where MPI does not start
std::unique_ptr<Ranks> start_mpi_ranks();

}  // namespace perilink
