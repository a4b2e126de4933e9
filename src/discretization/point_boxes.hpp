#pragma once

#include <span>
#include <vector>

#include "base/joined_parts.hpp"
#include "base/types.hpp"

namespace perilink {

/// Sorts points into boxes of about equal numbers of points: halves them along the longest axis
/// until no box has more than `most`.
/// \param positions  shape (points, dim)
/// \return numbers of the points of each box, ascending
std::vector<std::vector<Index>> split_into_boxes(std::span<const double> positions, int dim,
                                                 Index most);

/// Parts of a box that are not joined become boxes of their own.
/// \return those of the first box first
std::vector<std::vector<Index>> split_unjoined(const std::vector<std::vector<Index>>& boxes,
                                               JoinedParts& parts);

}  // namespace perilink
