#include "app/commands/commands.hpp"
#include "app/process/ranks.hpp"
#include "app/program.hpp"

/// The program. Among others that mpiexec started it goes on as the one that knows MPI, so that
/// nobody else waits for MPI's libraries.
int main(int argc, char** argv) {
  if (perilink::is_one_of_many()) {
    perilink::become_rank(argv);
    return perilink::exit_bad_input;
  }
  return perilink::run_program(argc, argv);
}
