#pragma once

#include <cstdint>
#include <vector>

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"

namespace perilink {

/// Scaled rows of a point, dense in their unknowns, with their right sides.
struct PointRows {
  std::vector<int> columns;  ///< ascending
  Eigen::MatrixXd values;    ///< shape (rows, columns)
  Eigen::VectorXd right;
};

/// Replaces the rows A of a point by U'A, with an orthonormal basis U of their span. Symmetry makes
/// some forces of the point vanish and others linearly dependent. A'A, the solution and the steps
/// stay unchanged.
/// \param basis  U, filled with zeros; a basis of an earlier problem is kept where it still spans
///     all rows
void turn_rows(PointRows& own, Eigen::MatrixXd& basis);

/// Removes linearly dependent rows of different points, where their right sides are consistent. The
/// solution does not change, and the time of a factor falls with the third power of their number.
/// Points with environments that differ only far away share nearly all bonds. Symmetry then makes
/// some of their rows linearly dependent.
/// \param implied  per row: whether it is removed; marks of an earlier problem are kept where
///     possible
void leave_out_implied(ReducedEquations& reduced, std::vector<std::uint8_t>& implied);

}  // namespace perilink
