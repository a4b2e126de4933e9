#pragma once

#include "solver/ranks.hpp"

namespace perilink {

/// Worker loop of all ranks except 0, until shutdown. An error here ends all ranks with a message,
/// to avoid a deadlock.
void serve(Ranks& ranks);

/// Shuts down the worker loops of the other ranks.
void dismiss(Ranks& ranks);

}  // namespace perilink
