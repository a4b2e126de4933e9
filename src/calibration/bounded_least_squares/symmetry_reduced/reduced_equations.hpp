#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Symmetry-reduced equations of bounded_least_squares(): variables share unknowns
/// (PointEquations::unknown), and the matrix has a column for each unknown. The unknown of n
/// variables is sqrt(n) times their change, w = 1 + (u - 1) / sqrt(n), so that squares of changes
/// are summed over all variables.
struct ReducedEquations {
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

  PointEquations equations;  ///< scaled right sides, ridge; bounds of the unknowns
  /// Scaled, shape (points * rows, unknowns). Linearly dependent rows of a point are replaced by a
  /// basis, filled with zeros.
  Matrix matrix;
  bool independent = false;       ///< whether linearly dependent rows are removed
  std::vector<double> root;       ///< sqrt(n) of each unknown
  std::vector<Index> unknown_of;  ///< per variable

  /// Returns the weights of the variables from the unknowns.
  std::vector<double> weights(std::span<const double> unknowns) const;
};

/// Choice of linearly independent rows. The next problem needs an equal choice, because it
/// continues with the factor and the multipliers.
struct IndependentRows {
  std::vector<Eigen::MatrixXd> bases;  ///< per point, shape (rows, rows)
  std::vector<std::uint8_t> implied;   ///< per row: whether it depends on other rows and is removed
};

/// Calls visit(first, last) for the ranges [first, last) of entries of a column, one range per
/// point.
/// \param columns  the matrix of symmetry-reduced equations, transposed
/// \param rows  number per point
template <class Visit>
void for_each_point(const ReducedEquations::Matrix& columns, Index column, Index rows,
                    Visit visit) {
  const int* begin = columns.innerIndexPtr();
  for (int k = columns.outerIndexPtr()[column]; k < columns.outerIndexPtr()[column + 1];) {
    const int first = k;
    while (k < columns.outerIndexPtr()[column + 1] && begin[k] / rows == begin[first] / rows) ++k;
    visit(first, k);
  }
}

/// Returns the pairs of points of every variable, the lower number first, in ascending order, with
/// repetitions. Pairs of a point with itself are included.
std::vector<std::pair<Index, Index>> shared_variables(const ReducedEquations::Matrix& columns,
                                                      Index rows);

}  // namespace perilink
