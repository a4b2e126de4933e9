#pragma once

#include <span>

#include <Eigen/Core>

#include "calibration/least_change/point_equations.hpp"

namespace perilink {

/// Multipliers that no bond feels: a symmetric tensor Y of third order at each point is felt by a
/// bond along n as the difference of Y n n n between its ends, and that is none for products of
/// three rigid motions, Y n n n = (u n) (v n) (w n), since the motions of the ends along n are the
/// same. These Killing tensors and their sums are all such fields that are smooth: ten in the
/// plane, fifty in space (docs/theory/calibration.md).
/// \param equations  third_order ones
/// \return orthonormal columns, shape (points * rows, fields); fewer fields where points are few
///         or lie on a line
Eigen::MatrixXd killing_fields(const PointEquations& equations, std::span<const Index> points);

}  // namespace perilink
