#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/factor.hpp"
#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// Factor in single precision for preconditioners. It has half the memory, and solutions, which are
/// in double precision, read half as much. The matrix need not be stored. It is dense in the blocks
/// of coupled points, so the graph of points gives ordering and supernodes.
class PreconditionerFactor {
 public:
  /// \param graph  lower triangle of the pattern by points; its values are ignored
  /// \param sizes  rows of each point
  /// \throws SolverError if memory is too small
  PreconditionerFactor(const SparseMatrix& graph, std::span<const Index> sizes, int threads);
  ~PreconditionerFactor();

  /// Returns the points in the order of elimination. The rows of the matrix must follow this order.
  std::span<const Index> order() const;
  /// Factorises a matrix of this pattern.
  /// \return whether the matrix is positive definite and finite in single precision
  bool factorize(const AddColumn& add);
  /// Solves a right side in place, size n.
  void solve(std::span<double> side);
  /// Returns the statistics with the entries of L and their bytes in single precision.
  FactorStatistics statistics() const;

 private:
  struct Parts;
  void turn_into_ldl();

  std::unique_ptr<Parts> parts_;
};

}  // namespace perilink
