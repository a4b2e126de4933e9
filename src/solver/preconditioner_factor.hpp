#pragma once

#include <memory>
#include <span>

#include "solver/factor.hpp"

namespace perilink {

/// A factor in single precision, for preconditioners that need no more digits: it takes half the
/// memory, and a solution, in double precision, reads half as much.
class PreconditionerFactor {
 public:
  /// \param lower  a matrix of the pattern, its unknowns in the order of elimination
  ///               (elimination_order())
  /// \throws SolverError  where there is no memory
  PreconditionerFactor(const SparseMatrix& lower, int threads);
  ~PreconditionerFactor();

  /// Factorises a matrix of this pattern.
  /// \return whether it is positive definite, and finite, in single precision
  bool factorize(const SparseMatrix& lower);
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
