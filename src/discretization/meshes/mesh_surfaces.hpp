#pragma once

#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Turns lines of the plane, or triangles in space, so that neighbours go on in the same way, each
/// connected piece as its first one does. Where more than two meet none goes on.
/// \param sides  corners, shape (sides, dim)
void turn_alike(std::vector<Index>& sides, int dim);

}  // namespace perilink
