#pragma once

#include <cholmod.h>

#include <memory>
#include <span>
#include <vector>

#include "solver/factor.hpp"
#include "solver/ordering.hpp"

/// \file
/// Shared use of CHOLMOD: its workspace, views of our matrices, and exceptions from its status.
/// Only files of this folder may include this header.

namespace perilink {

/// Parameters and workspace of CHOLMOD.
class CholmodSession {
 public:
  CholmodSession();
  ~CholmodSession();
  CholmodSession(const CholmodSession&) = delete;
  CholmodSession& operator=(const CholmodSession&) = delete;

  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_;
};

/// Owning pointer to a CHOLMOD factor.
struct CholmodFactorDeleter {
  cholmod_common* common;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common); }
};
using CholmodFactorPtr = std::unique_ptr<cholmod_factor, CholmodFactorDeleter>;

/// Analyses a matrix for a supernodal factor, with the ordering of ordering.hpp.
CholmodFactorPtr analyze_supernodal(CholmodSession& session, const SparseMatrix& lower,
                                    std::span<const Index> groups);

/// Factorises a matrix with the analysed pattern as L L'.
/// \throws SolverError
void factorize_numerically(CholmodSession& session, const SparseMatrix& lower,
                           cholmod_factor* factor, int threads);

/// Returns the size of a supernodal or simplicial factor.
/// \param flops  operations of one factorisation
FactorStatistics measure_factor(const cholmod_factor& factor, double flops);

/// Views of a matrix and a vector without copies.
cholmod_sparse view_lower(const SparseMatrix& lower);
cholmod_dense view_column(std::span<double> values);

/// Base class of factors that solve with CHOLMOD.
class CholmodRoute : public Factor {
 public:
  void solve(std::span<const double> rhs, std::span<double> solution) override;
  void solve_all(std::span<double> columns) override;
  SingleFactor in_single(double unit) const override;
  std::vector<double> columns(std::span<const SparseVector> x) override;
  void compliance(std::span<const SparseVector> x, std::span<double> result) override;
  FactorStatistics statistics() const override;

 protected:
  explicit CholmodRoute(int threads)
      : factor_(nullptr, CholmodFactorDeleter{session_.get()}), threads_(threads) {}
  /// Analyses a matrix and records its number of operations.
  CholmodFactorPtr analyze(const SparseMatrix& matrix, std::span<const Index> groups);
  /// Factorises a matrix with the analysed pattern into factor_.
  void compute(const SparseMatrix& matrix);
  /// Solves with the factor or a part of it.
  /// \param system  CHOLMOD_A, CHOLMOD_L, ...
  /// \param rhs     in the factor's order unless the system is CHOLMOD_A
  std::vector<double> solve_system(int system, std::vector<double> rhs);
  /// Updates the solution after a downdate with the changed factor. The residual of K u = f is sum
  /// (load_change + x'u) x. The result is independent of pivots and the Sherman-Morrison formula.
  void follow(std::span<const SparseVector> x, std::span<const double> load_changes,
              std::span<double> solution);

  CholmodSession session_;
  CholmodFactorPtr factor_;

 private:
  int threads_;
  int factorizations_ = 0;
  double flops_ = 0.0;
};

/// Column n x 1 with the entries of x in the factor's order, rows ascending.
class PermutedColumn {
 public:
  PermutedColumn(const SparseVector& x, std::span<const Index> position, Index size);
  PermutedColumn(const PermutedColumn&) = delete;
  PermutedColumn& operator=(const PermutedColumn&) = delete;
  cholmod_sparse* get() { return &matrix_; }
  const SparseVector& entries() const { return sorted_; }

 private:
  SparseVector sorted_;
  Index offsets_[2];
  cholmod_sparse matrix_;
};

/// Returns entries of x in the factor's order, rows ascending.
SparseVector permute(const SparseVector& x, std::span<const Index> position);

}  // namespace perilink
