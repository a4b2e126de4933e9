#pragma once

#include "solver/ranks.hpp"

namespace perilink {

/// Whether mpiexec has started this process as one of several.
bool is_one_of_many();

/// Goes on as perilink-mpi, which lies beside the program where it was built with MPI. Comes back
/// where there is none; the first process says so.
void become_rank(char** words);

/// The processes that share the work of this one, two at least; null where it is alone.
Ranks* ranks();
void set_ranks(Ranks* ranks);

}  // namespace perilink
