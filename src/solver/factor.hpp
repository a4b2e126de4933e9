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
  double entries = 0.0;     ///< stored numbers of L
  double bytes = 0.0;       ///< memory of L
  double most_bytes = 0.0;  ///< largest memory so far of what replaces L: cached columns
  double flops = 0.0;       ///< for one factorisation
  int factorizations = 0;   ///< number of factorisations
  int ranks = 1;            ///< processes that share the work
  int iterations = 0;       ///< conjugate-gradient iterations after batches of events
  Index subdomains = 0;     ///< number of subdomains if conjugate gradients replace a factor
};

/// Cholesky factor of a symmetric positive definite matrix K that follows changes of low rank.
/// solve(), columns(), compliance() and pivot() leave it unchanged; downdate() and update() change
/// it. It stores no load and no solution.
class Factor {
 public:
  virtual ~Factor() = default;

  /// Orders, analyses and factorises K.
  /// \param matrix  lower triangle
  /// \param groups  number of the particle of each unknown. Unknowns of one particle are adjacent.
  ///     The fill-reducing ordering uses the much smaller graph of the particles.
  /// \throws SolverError if K is not positive definite or memory is too small
  virtual void factorize(const SparseMatrix& matrix, std::span<const Index> groups) = 0;

  /// Factorises another matrix with the pattern of factorize().
  virtual void refactorize(const SparseMatrix& matrix) = 0;

  /// Computes solution = K^-1 rhs, both of size n; they may share memory.
  virtual void solve(std::span<const double> rhs, std::span<double> solution) = 0;

  /// Solves many right sides in place; the columns have size n and follow one another.
  virtual void solve_all(std::span<double> columns);

  /// Returns a copy of the factor of K / unit for preconditioners.
  /// \throws std::logic_error if the factor has no supernodes
  virtual SingleFactor in_single(double unit) const;

  /// Selects the entries of the solution that downdates must update, size n. Other entries may keep
  /// their old values. A factor may ignore the selection.
  virtual void keep_current(std::span<const std::uint8_t> /*wanted*/) {}

  /// Returns K^-1 x of each vector, shape (count, n); entries not selected by keep_current() may be
  /// zero.
  virtual std::vector<double> columns(std::span<const SparseVector> x) = 0;

  /// Computes x_a' K^-1 x_b of a few vectors that share a path, such as the vectors of one bond,
  /// shape (count, count).
  virtual void compliance(std::span<const SparseVector> x, std::span<double> result) = 0;

  /// Returns the downdate pivot 1 - x' K^-1 x = det(K - x x') / det(K). At or below zero, removing
  /// x x' would leave a mechanism.
  virtual double pivot(const SparseVector& x);

  /// Changes K to K - sum x x' and f to f + sum load_change x for vectors that do not interact.
  /// Then x_a' K^-1 x_b = 0 for a != b.
  /// \param pivots    pivot(x) of each vector, all positive
  /// \param solution  updated from before to after the removal; empty: no solution
  virtual void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                        std::span<const double> pivots, std::span<double> solution) = 0;

  /// Changes K to K - sum x x' for vectors that may interact, one after another.
  /// \return smallest of their downdate pivots; 0: K would lose positive definiteness, and the
  ///     factor is invalid until refactorize()
  virtual double downdate_together(std::span<const SparseVector> x);

  /// Returns the sum over the vectors of the numbers of L on their paths.
  virtual double path_of(std::span<const SparseVector> x) const;

  /// Adds K^-1 b to the solution.
  /// \param b  few entries, each row once
  virtual void add_solution(const SparseVector& b, std::span<double> solution);

  /// Changes K to K + x x' (a ground spring); the pattern of x x' must lie in the pattern of K.
  virtual void update(const SparseVector& x) = 0;

  virtual FactorStatistics statistics() const = 0;
};

/// Returns the sum over a of weights_a x_a.
SparseVector combine(std::span<const SparseVector> x, std::span<const double> weights);

/// Returns load_change + x'u of each vector.
std::vector<double> extensions(std::span<const SparseVector> x,
                               std::span<const double> load_changes, std::span<const double> u);

}  // namespace perilink
