#pragma once

#include <utility>
#include <vector>

#include "solver/factor.hpp"

namespace perilink {

/// Lower triangle of a symmetric matrix with dense blocks of pairs of points. Its pattern is known
/// before its values.
class PointMatrix {
 public:
  using Pairs = std::vector<std::pair<Index, Index>>;

  /// \param first_row  where the rows of each point begin, and the total at the end
  /// \param pairs  points that share a variable, the lower number first, in any order; pairs may
  ///     repeat
  PointMatrix(std::vector<Index> first_row, Pairs pairs);

  /// Returns where the rows of the lower point begin in a column of the upper point. In a point's
  /// own column, rows above the diagonal are not stored.
  double* block(Index upper, Index lower, Index column);

  void set_zero();
  const SparseMatrix& matrix() const { return matrix_; }
  std::vector<Index> point_of_rows() const;

 private:
  Index points() const { return static_cast<Index>(first_row_.size()) - 1; }
  Index rows(Index point) const { return first_row_[point + 1] - first_row_[point]; }

  std::vector<Index> first_row_;
  std::vector<Index> offsets_, later_;  // points after each one that share a variable with it
  std::vector<Index> below_;  // per later point: number of rows after the rows of the point itself
  SparseMatrix matrix_;
};

}  // namespace perilink
