#pragma once

#include <exception>
#include <string>

namespace perilink {

/// Memory that this process can still take: what the machine has free, or less where a limit
/// (ulimit -v, ulimit -d) is on the process; infinity where the system does not tell [bytes].
double available_memory();

/// What the limits on this process (ulimit -v, ulimit -d) leave it, infinity without one [bytes].
double available_address_space();

/// "1.5 GB", "12 MB".
std::string bytes_text(double bytes);

/// What to tell people of a failure: its own words, or of a lack of memory how much there is.
std::string failure_text(const std::exception& error);

}  // namespace perilink
