#include "solver/cholmod_updown_factor.hpp"

#include <utility>

#include "base/error.hpp"

namespace perilink {

CholmodUpdownFactor::CholmodUpdownFactor()
    : symbolic_(nullptr, CholmodFactorDeleter{session_.get()}) {}

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
    throw SolverError("out of memory while copying the analysis of the stiffness matrix");
  }
  compute(matrix);
  // CHOLMOD would do this at the first downdate; doing it here keeps it out of the events.
  if (!cholmod_change_factor(CHOLMOD_REAL, false, false, false, true, factor_.get(),
                             session_.get())) {
    throw SolverError("out of memory while turning the factor into a simplicial one");
  }
}

void CholmodUpdownFactor::follow_load(std::span<const double> load, std::span<double> solution) {
  std::vector<double> permuted(load.size());
  for (std::size_t k = 0; k < load.size(); ++k) permuted[position_[k]] = load[k];
  forward_ = solve_system(CHOLMOD_L, std::move(permuted));
  backward(solution);
}

/// solution = P' (D L')^-1 forward_
void CholmodUpdownFactor::backward(std::span<double> solution) {
  const std::vector<double> values = solve_system(CHOLMOD_DLt, forward_);
  for (std::size_t k = 0; k < solution.size(); ++k) solution[k] = values[position_[k]];
}

double CholmodUpdownFactor::prepare_downdate(const SparseVector& x) {
  x_ = x;
  if (x.size() == 0) return 1.0;
  PermutedColumn column(x, position_, static_cast<Index>(factor_->n));
  std::vector<double> rhs(factor_->n, 0.0);
  const SparseVector& entries = column.entries();
  for (int k = 0; k < entries.size(); ++k) rhs[entries.rows[k]] = entries.values[k];
  cholmod_dense b = view_column(rhs);
  if (!cholmod_solve2(CHOLMOD_L, factor_.get(), &b, column.get(), &solved_, &solved_set_,
                      &workspace_y_, &workspace_e_, session_.get())) {
    throw SolverError("out of memory while solving along a path");
  }
  const Index* rows = static_cast<const Index*>(solved_set_->i);
  const Index count = static_cast<const Index*>(solved_set_->p)[1];
  const double* p = static_cast<const double*>(solved_->x);
  const double* values = static_cast<const double*>(factor_->x);
  const Index* starts = static_cast<const Index*>(factor_->p);
  double removed = 0.0;
  for (Index k = 0; k < count; ++k) removed += p[rows[k]] * p[rows[k]] / values[starts[rows[k]]];
  return 1.0 - removed;
}

/// K -+ x x' and f + load_change x, the forward solution of f with them.
void CholmodUpdownFactor::change(bool add, const SparseVector& x, double load_change) {
  if (x.size() == 0) return;
  PermutedColumn column(x, position_, static_cast<Index>(factor_->n));
  std::vector<double> change(forward_.size(), 0.0);
  const SparseVector& entries = column.entries();
  for (int k = 0; k < entries.size(); ++k)
    change[entries.rows[k]] = load_change * entries.values[k];
  cholmod_dense forward = view_column(forward_);
  cholmod_dense delta = view_column(change);
  if (!cholmod_updown_solve(add, column.get(), factor_.get(), &forward, &delta, session_.get())) {
    throw SolverError("out of memory while changing the factor");
  }
}

void CholmodUpdownFactor::commit_downdate(double load_change, std::span<double> solution) {
  change(false, x_, load_change);
  backward(solution);
}

void CholmodUpdownFactor::update(const SparseVector& x, std::span<const double> solution) {
  double extension = 0.0;
  for (int k = 0; k < x.size(); ++k) extension += x.values[k] * solution[x.rows[k]];
  change(true, x, extension);
}

}  // namespace perilink
