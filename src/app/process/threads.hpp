#pragma once

namespace perilink {

/// Sets the number of threads of everything that follows: as many as are wanted, or fewer, with a
/// word on standard error, where a limit on the process leaves no room for them. Results do not
/// depend on it.
/// \param wanted  0: all processors
/// \return how many there are
int set_threads(int wanted);

}  // namespace perilink
