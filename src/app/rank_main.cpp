#include <algorithm>
#include <csignal>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/process/serve.hpp"
#include "app/program.hpp"
#include "solver/ranks/mpi_ranks.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

/// Ends with an error unless all ranks have the same command line, because all ranks work on the
/// case of rank 0.
void require_one_command(Ranks& ranks, int argc, char** argv) {
  std::string words;
  for (int k = 1; k < argc; ++k) words.append(argv[k]).push_back('\0');
  const std::span<const std::byte> own = std::as_bytes(std::span(words));
  if (!ranks.leads()) return ranks.send(0, own);
  for (int rank = 1; rank < ranks.count(); ++rank) {
    const std::vector<std::byte> others = ranks.receive(rank);
    if (std::equal(own.begin(), own.end(), others.begin(), others.end())) continue;
    ranks.abandon(
        "mpiexec has started different commands; all processes of one mpiexec "
        "must run the same case");
  }
}

}  // namespace
}  // namespace perilink

/// The program as one of several MPI processes. Rank 0 runs the command, the others compute their
/// parts of the body.
int main(int argc, char** argv) {
  using namespace perilink;
  const std::unique_ptr<Ranks> ranks = start_mpi_ranks();
  require_one_command(*ranks, argc, argv);
  if (!ranks->leads()) {
    // Only rank 0 handles stop signals; it then stops all ranks together.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
    serve(*ranks);
    return 0;
  }
  set_ranks(ranks.get());
  const int status = run_program(argc, argv);
  dismiss(*ranks);
  return status;
}
