#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// The curves that lines join up to, by their corners [length]: points in a straight line are left
/// out, and a closed curve ends where it begins. Where two lines meet the curve goes on; where more
/// do, as bars that cross, those that are straightest go on in each other, then two that are left.
/// A curve runs the way that most of its lines run, and begins there; curves stand in the order of
/// their first lines, open ones before closed ones. Points at the same place are one point.
/// \param points  shape (points, 3) [length]
/// \param lines   ends, shape (lines, 2); those without a length are left out
/// \throws std::invalid_argument where two lines have the same ends, or very many meet in a point
std::vector<std::vector<Vector3>> curves_of(std::span<const double> points,
                                            std::span<const Index> lines);

}  // namespace perilink
