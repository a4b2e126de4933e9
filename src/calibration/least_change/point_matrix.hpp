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

  /// \param rows   equations at each point
  /// \param pairs  points that share a variable, the lower number first, in any order and more
  ///               than once
  PointMatrix(Index rows, Index points, Pairs pairs);

  /// Whether the pattern holds these pairs of as many points.
  bool holds(Index points, const Pairs& pairs) const;

  /// Where the rows of a point begin in a column of another one before it, or in its own (where
  /// those above the column are not stored).
  double* block(Index upper, Index lower, Index column);

  void set_zero();
  const SparseMatrix& matrix() const { return matrix_; }
  std::vector<Index> point_of_rows() const;

 private:
  Index rows_;
  std::vector<Index> offsets_, later_;  // points after each one that share a variable with it
  SparseMatrix matrix_;
};

}  // namespace perilink
