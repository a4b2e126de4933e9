#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/sparse_vector.hpp"
#include "base/types.hpp"
#include "solver/single_factor.hpp"
#include "solver/supernodes/sparse_matrix.hpp"

namespace perilink {

/// Size and cost of a factor.
struct FactorStatistics {
  Index size = 0;
  double entries = 0.0;      ///< stored numbers of L
  double bytes = 0.0;        ///< memory of L
  double flops = 0.0;        ///< for one factorisation
  double event_bytes = 0.0;  ///< part of L that the last downdate read (in place only)
  int factorizations = 0;    ///< so far
  int ranks = 1;             ///< processes that share the work
  int iterations = 0;        ///< conjugate gradients after batches of events
  Index subdomains = 0;      ///< where conjugate gradients stand in for a factor
};

/// Cholesky factor of a symmetric positive definite matrix K that follows changes of low rank, and
/// a solution u of K u = f with it. It is looked at by solve(), columns(), compliance() and
/// pivot(), in any order, and changed by downdate() and update(); it keeps no load, no solution.
class Factor {
 public:
  virtual ~Factor() = default;

  /// Orders, analyses and factorises K.
  /// \param matrix  lower triangle
  /// \param groups  number of the particle of each unknown; the unknowns of one particle are
  ///                neighbours, and the fill-reducing ordering is made on the much smaller graph of
  ///                the particles
  /// \throws SolverError when K is not positive definite or does not fit in memory
  virtual void factorize(const SparseMatrix& matrix, std::span<const Index> groups) = 0;

  /// Factorises another matrix of the same pattern.
  virtual void refactorize(const SparseMatrix& matrix) = 0;

  /// solution = K^-1 rhs, both of size n; they may be the same memory.
  virtual void solve(std::span<const double> rhs, std::span<double> solution) = 0;

  /// Many right sides at once, solved where they are: one column after the other, each of size n.
  virtual void solve_all(std::span<double> columns);

  /// A copy of the factor of K / unit for preconditioners.
  /// \throws std::logic_error  where the route keeps no supernodes
  virtual SingleFactor in_single(double unit) const;

  /// Says which entries of the solution a downdate has to keep current, size n; it may leave the
  /// others as they are. A route may ignore it.
  virtual void keep_current(std::span<const std::uint8_t> /*wanted*/) {}

  /// K^-1 x of many vectors at once, one after the other in the result, shape (count, n). Entries
  /// that keep_current() does not want may be zero.
  virtual std::vector<double> columns(std::span<const SparseVector> x) = 0;

  /// x_a' K^-1 x_b of a few vectors that share a path (those of one bond), row after row in
  /// `result`, shape (count, count).
  virtual void compliance(std::span<const SparseVector> x, std::span<double> result) = 0;

  /// 1 - x' K^-1 x, which is det(K - x x') / det(K). At or below zero the removal of x x' would
  /// leave a mechanism.
  virtual double pivot(const SparseVector& x);

  /// K <- K - sum x x', f <- f + sum load_change x for vectors that do not interact: x_a' K^-1
  /// x_b = 0 where a and b differ.
  /// \param pivots    pivot(x) of each, all positive
  /// \param solution  before the removal on entry, after it on return; empty: none is wanted
  virtual void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                        std::span<const double> pivots, std::span<double> solution) = 0;

  /// K <- K - sum x x' for vectors that may interact, one after the other.
  /// \return the smallest of the pivots that they have then; 0: K would not stay positive definite,
  ///         and the factor is of no use until refactorize()
  virtual double downdate_together(std::span<const SparseVector> x);

  /// Numbers of L that the paths of the vectors hold, each path counted.
  virtual double path_of(std::span<const SparseVector> x) const;

  /// solution += K^-1 b for a b with few entries, of these rows, each once.
  virtual void add_solution(const SparseVector& b, std::span<double> solution);

  /// K <- K + x x' (a ground spring); the pattern of x must lie in that of the matrix.
  virtual void update(const SparseVector& x) = 0;

  /// Numerical factorisations so far.
  virtual int factorizations() const = 0;

  virtual FactorStatistics statistics() const = 0;
};

/// sum over a of weights_a x_a
SparseVector combine(std::span<const SparseVector> x, std::span<const double> weights);

/// load_change + x'u of each vector.
std::vector<double> extensions(std::span<const SparseVector> x,
                               std::span<const double> load_changes, std::span<const double> u);

}  // namespace perilink
