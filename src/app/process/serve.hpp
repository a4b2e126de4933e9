#pragma once

#include "solver/ranks.hpp"

namespace perilink {

/// What the other ranks do until the first dismisses them. What goes wrong here ends all ranks with
/// a message: the others would wait for ever.
void serve(Ranks& ranks);

/// Lets the other ranks come back from serve().
void dismiss(Ranks& ranks);

}  // namespace perilink
