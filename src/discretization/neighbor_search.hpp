#pragma once

#include <span>

#include "base/csr.hpp"

namespace perilink {

/// Neighbours j > i within `radius` [length] of every point i, each row sorted ascending.
/// \param positions  shape (n, dim)
Csr find_upper_neighbors(std::span<const double> positions, int dim, double radius);

}  // namespace perilink
