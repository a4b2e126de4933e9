#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "calibration/least_change/equations/point_equations.hpp"

namespace perilink {

/// The problem of least_change() whose variables share unknowns (PointEquations::unknown), with a
/// column of the matrix for each unknown. That of n variables stands for sqrt(n) times their
/// change, w = 1 + (u - 1) / sqrt(n), so that squares of changes count for each variable.
struct TiedEquations {
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

/// What is left of the rows of the points, kept for the next search: its factor and multipliers go
/// by it.
struct TiedRows {
  std::vector<Eigen::MatrixXd> bases;  ///< per point, shape (rows, rows)
  std::vector<std::uint8_t> implied;   ///< per row: whether it follows from others, and is left out
};

/// Calls visit(first, last) for the entries of a column, [first, last), at one point each.
/// \param columns  the matrix of tied equations, transposed
/// \param rows     how many each point has
template <class Visit>
void for_each_point(const TiedEquations::Matrix& columns, Index column, Index rows, Visit visit) {
  const int* begin = columns.innerIndexPtr();
  for (int k = columns.outerIndexPtr()[column]; k < columns.outerIndexPtr()[column + 1];) {
    const int first = k;
    while (k < columns.outerIndexPtr()[column + 1] && begin[k] / rows == begin[first] / rows) ++k;
    visit(first, k);
  }
}

/// Pairs of points that share a variable, the lower number first, one for each such variable, in
/// ascending order; each point with itself for every variable that it has.
std::vector<std::pair<Index, Index>> shared_variables(const TiedEquations::Matrix& columns,
                                                      Index rows);

}  // namespace perilink
