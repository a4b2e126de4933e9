#pragma once

#include <span>

#include "base/csr.hpp"

namespace perilink {

/// Neighbours j > i within `radius` [length] of every point i, each row sorted ascending.
/// \param positions  shape (n, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
Csr find_upper_neighbors(std::span<const double> positions, int dim, double radius);

/// Points within `radius` [length] of every query; row q is sorted ascending.
/// \param points   shape (n, dim)
/// \param queries  shape (rows of the result, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
Csr find_neighbors(std::span<const double> points, std::span<const double> queries, int dim,
                   double radius);

}  // namespace perilink
