#pragma once

#include <string>

namespace perilink {

/// Returns the processors granted to a container (docker run --cpus), from the cgroup files,
/// version 2 or 1, at their visible root; infinity: no limit. OpenMP counts the processors of the
/// host.
double granted_processors(const std::string& cgroups = "/sys/fs/cgroup");

/// Returns OMP_NUM_THREADS, or all processors that the process may use and is granted.
int default_threads();

/// Sets the number of threads for all later work. Uses fewer than wanted, with a message on
/// standard error, where process limits or libraries allow fewer. Results do not depend on the
/// number.
/// \param wanted  0: default_threads()
/// \return the number of threads
int set_threads(int wanted);

}  // namespace perilink
