#pragma once

namespace perilink {

/// Whether mpiexec has started this process as one of several.
bool is_one_of_many();

/// Replaces this process by perilink-mpi, which builds with MPI install next to the program.
/// Returns where it does not exist; the first process then prints an error.
void become_rank(char** words);

}  // namespace perilink
