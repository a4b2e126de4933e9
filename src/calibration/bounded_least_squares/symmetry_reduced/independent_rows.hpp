#pragma once

#include <cstdint>
#include <vector>

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"

namespace perilink {

/// The scaled rows of a point, dense in the unknowns that take part, and their right sides.
struct PointRows {
  std::vector<int> columns;  ///< ascending
  Eigen::MatrixXd values;    ///< shape (rows, columns)
  Eigen::VectorXd right;
};

/// Symmetry of a point makes some of its forces vanish and others linearly dependent. Such points
/// get U'A in place of their rows A, U an orthonormal basis of their span: A'A stays, and with it
/// the solution and the steps towards it.
/// \param basis  U with zeros behind it, of an earlier problem where it still holds all
void turn_rows(PointRows& own, Eigen::MatrixXd& basis);

/// Places that differ only far away share nearly all of their bonds, and symmetry makes some of
/// their rows follow from those of the others: one that looks to its left like a first and to its
/// right like a second follows from both. Such rows are left out, which a factor feels with the
/// third power of their number; the answer is the same. Where the right sides contradict each other
/// all stay.
/// \param implied  per row; those of an earlier search are left out again where they can be
void leave_out_implied(ReducedEquations& reduced, std::vector<std::uint8_t>& implied);

}  // namespace perilink
