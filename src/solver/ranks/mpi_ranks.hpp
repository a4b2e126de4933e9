#pragma once

#include <memory>

#include "solver/ranks.hpp"

namespace perilink {

/// The processes that mpiexec has started. Each process makes one object, before anything else, and
/// destroys it last.
/// \throws SolverError where MPI does not start
std::unique_ptr<Ranks> start_mpi_ranks();

}  // namespace perilink
