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
/// count for each variable.
struct ReducedEquations {
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

  PointEquations equations;  ///< scaled right sides, ridge; bounds of the unknowns
  /// Scaled, shape (points * rows, unknowns). Where rows of a point follow from each other they are
  /// those of a basis, and zero behind it.
  Matrix matrix;
  bool independent = false;       ///< rows that follow from others are left out
  std::vector<double> root;       ///< sqrt(n) of each unknown
  std::vector<Index> unknown_of;  ///< per variable

  /// Weights of the variables from the unknowns.
  std::vector<double> weights(std::span<const double> unknowns) const;
};

/// Choice of linearly independent rows, kept for the next problem, which goes on with the factor
/// and the multipliers.
struct IndependentRows {
  std::vector<Eigen::MatrixXd> bases;  ///< per point, shape (rows, rows)
  std::vector<std::uint8_t> implied;   ///< per row: whether it follows from others, and is left out
};

/// Calls visit(first, last) for the entries of a column, [first, last), at one point each.
/// \param columns  the matrix of symmetry-reduced equations, transposed
/// \param rows     how many each point has
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

/// Pairs of points that share a variable, the lower number first, one for each such variable, in
/// ascending order; each point with itself for every variable that it has.
std::vector<std::pair<Index, Index>> shared_variables(const ReducedEquations::Matrix& columns,
                                                      Index rows);

}  // namespace perilink
