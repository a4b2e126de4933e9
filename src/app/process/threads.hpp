#pragma once

namespace perilink {

/// Sets the number of threads of everything that follows: as many as are wanted, or fewer, with a
/// word on standard error, where a limit on the process leaves no room for them. Results do not
/// depend on it.
/// \param wanted  0: what OMP_NUM_THREADS says, or all processors that the process may use
/// \return how many there are
int set_threads(int wanted);

}  // namespace perilink
