#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/csr.hpp"

namespace perilink {

/// Returns neighbours j > i within `radius` [length] of every point i; rows are ascending.
/// \param positions  shape (n, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
Csr find_upper_neighbors(std::span<const double> positions, int dim, double radius);

/// Returns points within `radius` [length] of every query; rows are ascending.
/// \param points   shape (n, dim)
/// \param queries  shape (rows of the result, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
Csr find_neighbors(std::span<const double> points, std::span<const double> queries, int dim,
                   double radius);

/// Returns points within a radius per query [length]; rows are ascending.
/// \param points   shape (n, dim)
/// \param queries  shape (rows of the result, dim)
/// \param radii    per query [length]
/// \throws std::invalid_argument for a dimension other than 2 or 3
Csr find_neighbors_within(std::span<const double> points, std::span<const double> queries, int dim,
                          std::span<const double> radii);

/// Returns the distance from every point to its count-th nearest other point [length]. Infinite if
/// there are fewer others.
/// \param positions  shape (n, dim)
/// \throws std::invalid_argument for a dimension other than 2 or 3
std::vector<double> distances_of_nearest(std::span<const double> positions, int dim, int count);

/// Finds the point that is nearest to a place.
class NearestPoint {
 public:
  /// \param positions  shape (n, dim), n > 0 [length]
  /// \throws std::invalid_argument for a dimension other than 2 or 3
  NearestPoint(std::vector<double> positions, int dim);

  /// \param place  size dim [length]
  Index at(std::span<const double> place) const { return search_(place); }

 private:
  std::function<Index(std::span<const double>)> search_;
};

}  // namespace perilink
