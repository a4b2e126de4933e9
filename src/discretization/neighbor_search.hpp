#pragma once

#include <span>
#include <vector>

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

/// The same with a radius of each query's own.
Csr find_neighbors_within(std::span<const double> points, std::span<const double> queries, int dim,
                          std::span<const double> radii);

/// Distance of the count-th nearest other point from every point [length]; infinite where there are
/// fewer others.
/// \param positions  shape (n, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
std::vector<double> distances_of_nearest(std::span<const double> positions, int dim, int count);

}  // namespace perilink
