#include "app/commands/commands.hpp"
#include "app/process/rank_start.hpp"
#include "app/program.hpp"

/// The program. As one of several MPI processes it continues as perilink-mpi, so that serial runs
/// need not load the MPI libraries.
int main(int argc, char** argv) {
  if (perilink::is_one_of_many()) {
    perilink::become_rank(argv);
    return perilink::exit_bad_input;
  }
  return perilink::run_program(argc, argv);
}
