#pragma once

#include "solver/ranks.hpp"

namespace perilink {

/// Returns the communicator of at least two processes; null in serial runs.
Ranks* ranks();

/// Sets the communicator that ranks() returns. It must outlive all runs.
void set_ranks(Ranks* ranks);

}  // namespace perilink
