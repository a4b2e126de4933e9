#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Returns curves that the lines form, by their corners [length].
/// - Points on a straight line are omitted; a closed curve ends at its first point.
/// - Where two lines meet, the curve continues. Where more meet, as at crossing bars, the
///   straightest pairs continue, then the last two left.
/// - A curve has the direction of most of its lines' length.
/// - Curves have the order of their first lines, open before closed ones.
/// - Points at one position are one point.
/// \param points  shape (points, 3) [length]
/// \param lines   ends, shape (lines, 2); lines without length are ignored
/// \throws std::invalid_argument if two lines have equal ends, or more than 100 meet in a point
std::vector<std::vector<Vector3>> curves_of(std::span<const double> points,
                                            std::span<const Index> lines);

}  // namespace perilink
