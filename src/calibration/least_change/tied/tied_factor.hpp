#pragma once

#include <memory>
#include <span>
#include <vector>

#include "calibration/least_change/equations/point_matrix.hpp"
#include "calibration/least_change/tied/tied_equations.hpp"
#include "solver/preconditioner_factor.hpp"

namespace perilink {

/// Factor of the system of tied variables, M D M' + shift.
class TiedFactor {
 public:
  /// \param columns  the matrix, transposed
  TiedFactor(const TiedEquations& tied, const TiedEquations::Matrix& columns);

  /// Whether it can be made for these columns, too.
  bool fits(const TiedEquations& tied, const TiedEquations::Matrix& columns) const;
  /// \param mobility  D
  /// \param shift     added to the diagonal
  void factorize(const TiedEquations::Matrix& columns, std::span<const double> mobility,
                 std::span<const double> shift);
  void solve(std::span<const double> residual, std::span<double> result) const;
  /// Iterations of conjugate gradients that take as long as a new factor, and those for which one
  /// is made: it serves the solutions behind this one, too.
  double price() const;
  double worth() const;
  /// What a factor takes, and a solution in operations of a factor.
  double operations() const { return statistics_.flops; }
  double operations_of_solution() const;

 private:
  PointMatrix::Pairs in_order(PointMatrix::Pairs pairs) const;
  PointMatrix make_matrix(const TiedEquations& tied, const PointMatrix::Pairs& pairs);

  Index rows_;
  std::vector<Index> order_;  // per point: where it comes in the order of elimination
  std::vector<Index> row_;    // those that hold something, in that order
  std::vector<Index> place_;  // per row: its place among those of its point; no_index: none
  FactorStatistics statistics_;
  PointMatrix matrix_;
  std::unique_ptr<PreconditionerFactor> factor_;
};

}  // namespace perilink
