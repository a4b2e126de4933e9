#pragma once

#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Gives lines in the plane, or triangles in space, a consistent orientation within each connected
/// piece, given by its first side. Pieces end where more than two sides meet.
/// \param sides  corners, shape (sides, dim)
void turn_alike(std::vector<Index>& sides, int dim);

}  // namespace perilink
