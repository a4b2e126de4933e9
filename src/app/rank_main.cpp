#include "analysis/quasistatic/ranks/team.hpp"
#include "app/process/ranks.hpp"
#include "app/program.hpp"
#include "solver/ranks/petsc_ranks.hpp"

/// The program as one of several processes under mpiexec: the first runs the command, the others
/// take their parts of the body.
int main(int argc, char** argv) {
  using namespace perilink;
  const std::unique_ptr<Ranks> ranks = start_petsc_ranks();
  if (!ranks->leads()) {
    serve(*ranks);
    return 0;
  }
  set_ranks(ranks.get());
  const int status = run_program(argc, argv);
  dismiss(*ranks);
  return status;
}
