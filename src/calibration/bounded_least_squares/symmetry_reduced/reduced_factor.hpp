#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"
#include "solver/preconditioner_factor.hpp"

namespace perilink {

/// Factor of the symmetry-reduced system M D M' + shift.
class ReducedFactor {
 public:
  /// \param columns  the matrix, transposed
  /// \throws SolverError  where there is no memory for the factor
  ReducedFactor(const ReducedEquations& reduced, const ReducedEquations::Matrix& columns);

  /// Whether the pattern of the factor fits these columns.
  bool fits(const ReducedEquations& reduced, const ReducedEquations::Matrix& columns) const;
  /// Sorts the entries of each unknown in the order of elimination, for factorize().
  void sort(ReducedEquations::Matrix& columns) const;
  /// Factorises the system, column by column, without storing it.
  /// \param matrix    M
  /// \param columns  M transposed and sorted
  /// \param active_weight  D
  /// \param shift     added to the diagonal
  /// \throws SolverError  where the system has no factor
  void factorize(const ReducedEquations::Matrix& matrix, const ReducedEquations::Matrix& columns,
                 std::span<const double> active_weight, std::span<const double> shift);
  void solve(std::span<const double> residual, std::span<double> result) const;
  /// Returns the number of solutions that take as long as a factorisation.
  double iterations_of_factor() const;

 private:
  std::vector<int> own_entries(const ReducedEquations::Matrix& matrix,
                               const ReducedEquations::Matrix& columns) const;

  Index rows_;
  std::vector<std::pair<Index, Index>> pairs_;  // points that share a variable, ascending
  std::vector<Index> row_;                      // nonzero rows in the order of elimination
  std::vector<Index> place_;                    // per row: position in row_; no_index: zero row
  std::unique_ptr<PreconditionerFactor> factor_;
};

}  // namespace perilink
