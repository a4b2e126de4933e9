#pragma once

#include <exception>
#include <string>

namespace perilink {

/// Returns memory that this process can still allocate [bytes]: free memory, or less under ulimit
/// -v or -d. Infinity if unknown.
double available_memory();

/// Returns address space that ulimit -v and -d still allow [bytes]; infinity without a limit.
double available_address_space();

/// Returns the text of a size, such as "1.5 GB" or "12 MB".
std::string bytes_text(double bytes);

/// Returns the message of the error; for a lack of memory, the available memory and the remedy.
std::string failure_text(const std::exception& error);

}  // namespace perilink
