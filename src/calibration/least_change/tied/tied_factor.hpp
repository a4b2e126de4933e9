#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "calibration/least_change/tied/tied_equations.hpp"
#include "solver/preconditioner_factor.hpp"

namespace perilink {

/// Factor of the system of tied variables, M D M' + shift.
class TiedFactor {
 public:
  /// \param columns  the matrix, transposed
  /// \throws SolverError  where there is no memory for the factor
  TiedFactor(const TiedEquations& tied, const TiedEquations::Matrix& columns);

  /// Whether it can be made for these columns, too.
  bool fits(const TiedEquations& tied, const TiedEquations::Matrix& columns) const;
  /// Sorts the entries of each unknown in the order of elimination, which factorize() asks for.
  void sort(TiedEquations::Matrix& columns) const;
  /// The system is not stored: the factor asks for one column after the other.
  /// \param matrix    M
  /// \param columns   the same, transposed and sorted
  /// \param mobility  D
  /// \param shift     added to the diagonal
  /// \throws SolverError  where there is none
  void factorize(const TiedEquations::Matrix& matrix, const TiedEquations::Matrix& columns,
                 std::span<const double> mobility, std::span<const double> shift);
  void solve(std::span<const double> residual, std::span<double> result) const;
  /// Iterations of conjugate gradients that take as long as a new factor, and those for which one
  /// is made: it serves the solutions behind this one, too.
  double price() const;
  double worth() const;
  /// What a factor takes, and a solution in operations of a factor.
  double operations() const { return statistics_.flops; }
  double operations_of_solution() const;

 private:
  std::vector<int> own_entries(const TiedEquations::Matrix& matrix,
                               const TiedEquations::Matrix& columns) const;

  Index rows_;
  std::vector<std::pair<Index, Index>> pairs_;  // points that share a variable, ascending
  std::vector<Index> row_;    // those that hold something, in the order of elimination
  std::vector<Index> place_;  // per row: where it comes there; no_index: not
  std::unique_ptr<PreconditionerFactor> factor_;
  FactorStatistics statistics_;
};

}  // namespace perilink
