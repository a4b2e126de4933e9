#include "app/process/rank_start.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/process/console.hpp"

namespace perilink {
namespace {

/// Returns the first environment variable that is set, as a number; -1: none.
int first_of(std::initializer_list<const char*> variables) {
  for (const char* name : variables) {
    if (const char* text = std::getenv(name)) return std::atoi(text);
  }
  return -1;
}

}  // namespace

// variables of Open MPI; of MPICH and its derivatives
bool is_one_of_many() { return first_of({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) > 1; }

void become_rank(char** words) {
  std::error_code fault;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", fault);
  const std::string program = (self.parent_path() / "perilink-mpi").string();
  if (!fault) execv(program.c_str(), words);
  if (first_of({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}) <= 0) {
    complain(
        "mpiexec started several processes, but this build has no MPI: each "
        "would run the whole case\n  start one process without mpiexec, or "
        "build with MPI (docs/mpi.md)");
  }
}

}  // namespace perilink
