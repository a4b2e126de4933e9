#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/factor.hpp"
#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// A factor in single precision, for preconditioners that need no more digits: it takes half the
/// memory, and a solution, in double precision, reads half as much. The matrix, which need not be
/// stored, is dense in the blocks of pairs of points: their graph gives order and supernodes.
class PreconditionerFactor {
 public:
  /// \param graph  lower triangle of the pattern by points; its numbers are not read
  /// \param sizes  rows of each point
  /// \throws SolverError  where there is no memory
  PreconditionerFactor(const SparseMatrix& graph, std::span<const Index> sizes, int threads);
  ~PreconditionerFactor();

  /// The points in the order of elimination: so come the rows of the matrix.
  std::span<const Index> order() const;
  /// Factorises a matrix of this pattern.
  /// \return whether it is positive definite, and finite, in single precision
  bool factorize(const AddColumn& add);
  /// Solves the right side where it is, size n.
  void solve(std::span<double> side);
  /// Entries are those of L, bytes those that single precision takes.
  FactorStatistics statistics() const;

 private:
  struct Parts;
  void turn_into_ldl();

  std::unique_ptr<Parts> parts_;
};

}  // namespace perilink
