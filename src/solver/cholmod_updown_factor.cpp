#include "solver/cholmod_updown_factor.hpp"

#include <utility>

#include "base/error.hpp"

namespace perilink {

CholmodUpdownFactor::CholmodUpdownFactor(int threads)
    : CholmodRoute(threads), symbolic_(nullptr, CholmodFactorDeleter{session_.get()}) {}

CholmodUpdownFactor::~CholmodUpdownFactor() {
  cholmod_free_dense(&solved_, session_.get());
  cholmod_free_sparse(&solved_set_, session_.get());
  cholmod_free_dense(&workspace_y_, session_.get());
  cholmod_free_dense(&workspace_e_, session_.get());
}

void CholmodUpdownFactor::factorize(const SparseMatrix& matrix, std::span<const Index> groups) {
  symbolic_ = analyze(matrix, groups);
  position_ = invert({static_cast<const Index*>(symbolic_->Perm), symbolic_->n});
  refactorize(matrix);
}

void CholmodUpdownFactor::refactorize(const SparseMatrix& matrix) {
  factor_.reset();
  factor_ = CholmodFactorPtr(cholmod_copy_factor(symbolic_.get(), session_.get()),
                             CholmodFactorDeleter{session_.get()});
  if (!factor_) {
    throw SolverError("out of memory while copying the symbolic factor of the stiffness matrix");
  }
  compute(matrix);
  // CHOLMOD would convert at the first downdate; converting here keeps the time out of the events.
  if (!cholmod_change_factor(CHOLMOD_REAL, false, false, false, true, factor_.get(),
                             session_.get())) {
    throw SolverError("out of memory while converting the factor to a simplicial one");
  }
}

/// Returns L^-1 P x, computed along the path of x.
std::vector<double> CholmodUpdownFactor::forward(const SparseVector& x) {
  std::vector<double> result(factor_->n, 0.0);
  if (x.size() == 0) return result;
  PermutedColumn column(x, position_, static_cast<Index>(factor_->n));
  std::vector<double> rhs(factor_->n, 0.0);
  const SparseVector& entries = column.entries();
  for (int k = 0; k < entries.size(); ++k) rhs[entries.rows[k]] = entries.values[k];
  cholmod_dense b = view_column(rhs);
  if (!cholmod_solve2(CHOLMOD_L, factor_.get(), &b, column.get(), &solved_, &solved_set_,
                      &workspace_y_, &workspace_e_, session_.get())) {
    throw SolverError("out of memory while solving with a sparse right side");
  }
  const Index* rows = static_cast<const Index*>(solved_set_->i);
  const Index count = static_cast<const Index*>(solved_set_->p)[1];
  const double* p = static_cast<const double*>(solved_->x);
  for (Index k = 0; k < count; ++k) result[rows[k]] = p[rows[k]];
  return result;
}

std::vector<double> CholmodUpdownFactor::columns(std::span<const SparseVector> x) {
  std::vector<double> result;
  result.reserve(x.size() * factor_->n);
  for (const SparseVector& column : x) {
    const std::vector<double> values = solve_system(CHOLMOD_DLt, forward(column));
    for (const Index place : position_) result.push_back(values[place]);
  }
  return result;
}

void CholmodUpdownFactor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  const double* values = static_cast<const double*>(factor_->x);
  const Index* starts = static_cast<const Index*>(factor_->p);
  std::vector<std::vector<double>> p;
  for (std::size_t a = 0; a < x.size(); ++a) {
    p.push_back(forward(x[a]));
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < p[a].size(); ++k) sum += p[a][k] * p[b][k] / values[starts[k]];
      result[a * x.size() + b] = result[b * x.size() + a] = sum;
    }
  }
}

/// Changes K to K + x x' (add) or K - x x'.
void CholmodUpdownFactor::change(bool add, const SparseVector& x) {
  if (x.size() == 0) return;
  PermutedColumn column(x, position_, static_cast<Index>(factor_->n));
  if (!cholmod_updown(add, column.get(), factor_.get(), session_.get())) {
    throw SolverError("out of memory while changing the factor");
  }
}

void CholmodUpdownFactor::downdate(std::span<const SparseVector> x,
                                   std::span<const double> load_changes,
                                   std::span<const double> /*pivots*/, std::span<double> solution) {
  for (const SparseVector& column : x) change(false, column);
  follow(x, load_changes, solution);
}

void CholmodUpdownFactor::update(const SparseVector& x) { change(true, x); }

}  // namespace perilink
