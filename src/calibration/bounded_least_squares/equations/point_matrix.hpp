#pragma once

#include <utility>
#include <vector>

#include "solver/factor.hpp"

namespace perilink {

/// Lower triangle of a symmetric matrix that is dense in the blocks of pairs of points, its pattern
/// known before its numbers.
class PointMatrix {
 public:
  using Pairs = std::vector<std::pair<Index, Index>>;

  /// \param first_row  where the rows of each point begin, and at the end the number of all
  /// \param pairs      points that share a variable, the lower number first, in any order and more
  ///                   than once
  PointMatrix(std::vector<Index> first_row, Pairs pairs);

  /// Where the rows of a point begin in a column of another one before it, or in its own (where
  /// those above the column are not stored).
  double* block(Index upper, Index lower, Index column);

  void set_zero();
  const SparseMatrix& matrix() const { return matrix_; }
  std::vector<Index> point_of_rows() const;

 private:
  Index points() const { return static_cast<Index>(first_row_.size()) - 1; }
  Index rows(Index point) const { return first_row_[point + 1] - first_row_[point]; }

  std::vector<Index> first_row_;
  std::vector<Index> offsets_, later_;  // points after each one that share a variable with it
  std::vector<Index> below_;            // per later point: rows behind those of the point itself
  SparseMatrix matrix_;
};

}  // namespace perilink
