#pragma once

#include <cstdint>
#include <span>

#include <Eigen/SparseCore>

#include "base/sparse_vector.hpp"
#include "base/types.hpp"

namespace perilink {

/// Symmetric matrix; only the lower triangle is stored.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Size and cost of a factor.
struct FactorStatistics {
  Index size = 0;
  double entries = 0.0;      ///< stored numbers of L
  double bytes = 0.0;        ///< memory of L
  double flops = 0.0;        ///< for one factorisation
  double event_bytes = 0.0;  ///< part of L that the last downdate read (in place only)
  int factorizations = 0;    ///< so far
};

/// Cholesky factor of a symmetric positive definite matrix K that follows rank-one changes, and the
/// solution u of K u = f for one load f that follows with it.
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

  /// Factorises another matrix of the same pattern; the load to be followed is forgotten.
  virtual void refactorize(const SparseMatrix& matrix) = 0;

  /// solution = K^-1 rhs, both of size n; they may be the same memory.
  virtual void solve(std::span<const double> rhs, std::span<double> solution) = 0;

  /// Solves K u = f and follows this load through the downdates to come.
  virtual void follow_load(std::span<const double> load, std::span<double> solution) = 0;

  /// Says which entries of the solution commit_downdate has to keep current, size n; the others may
  /// be left as they are until follow_load is called again. A route may ignore it.
  virtual void keep_current(std::span<const std::uint8_t> /*wanted*/) {}

  /// Looks at the removal of x x' and changes nothing: the pivot 1 - x' K^-1 x, which is
  /// det(K - x x') / det(K). At or below zero the removal would leave a mechanism.
  virtual double prepare_downdate(const SparseVector& x) = 0;

  /// Carries out the removal prepared last: K <- K - x x', f <- f + load_change x.
  /// \param solution  under the load followed: before the removal on entry, after it on return
  virtual void commit_downdate(double load_change, std::span<double> solution) = 0;

  /// x_a' K^-1 x_b of a few vectors that share a path (those of one bond), row after row in
  /// `result`, shape (n, n). Changes nothing, but forgets what prepare_downdate prepared.
  virtual void compliance(std::span<const SparseVector> x, std::span<double> result);

  /// K <- K - sum x x', f <- f + sum load_change x for vectors that do not interact: x_a' K^-1
  /// x_b = 0 where a and b differ.
  /// \param pivots    1 - x' K^-1 x of each, all positive
  /// \param solution  as in commit_downdate
  virtual void downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                        std::span<const double> pivots, std::span<double> solution);

  /// K <- K + x x' (a ground spring); the pattern of x must lie in that of the matrix. The load
  /// that is followed grows by x (x'u), the force of the spring, so that its solution u stays where
  /// it is.
  virtual void update(const SparseVector& x, std::span<const double> solution) = 0;

  /// Numerical factorisations so far.
  virtual int factorizations() const = 0;

  virtual FactorStatistics statistics() const = 0;
};

}  // namespace perilink
