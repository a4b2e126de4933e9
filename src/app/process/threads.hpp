#pragma once

#include <string>

namespace perilink {

/// Processors whose time a container may take (docker run --cpus), by the files of cgroups, version
/// 2 or 1, at the root that it sees; infinity: all. OpenMP counts the processors of the host there.
double granted_processors(const std::string& cgroups = "/sys/fs/cgroup");

/// Sets the number of threads of everything that follows: as many as are wanted, or fewer, with a
/// word on standard error, where a limit on the process leaves no room for them or the libraries
/// serve no more. Results do not depend on it.
/// \param wanted  0: what OMP_NUM_THREADS says, or all processors that the process may use and is
///                granted
/// \return how many there are
int set_threads(int wanted);

}  // namespace perilink
