#include "solver/cholmod_updown_factor.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace perilink {

CholmodUpdownFactor::CholmodUpdownFactor()
    : symbolic_(nullptr, CholmodFactorDeleter{session_.get()}),
      factor_(nullptr, CholmodFactorDeleter{session_.get()}) {}

CholmodUpdownFactor::~CholmodUpdownFactor() {
  cholmod_free_dense(&solved_, session_.get());
  cholmod_free_sparse(&solved_set_, session_.get());
  cholmod_free_dense(&workspace_y_, session_.get());
  cholmod_free_dense(&workspace_e_, session_.get());
}

void CholmodUpdownFactor::factorize(const SparseMatrix& matrix, std::span<const Index> groups) {
  symbolic_ = analyze_supernodal(session_, matrix, groups);
  position_ = invert({static_cast<const Index*>(symbolic_->Perm), symbolic_->n});
  flops_ = session_.get()->fl;
  refactorize(matrix);
}

void CholmodUpdownFactor::refactorize(const SparseMatrix& matrix) {
  factor_.reset();
  factor_ = CholmodFactorPtr(cholmod_copy_factor(symbolic_.get(), session_.get()),
                             CholmodFactorDeleter{session_.get()});
  if (!factor_) {
    throw SolverError("out of memory while copying the analysis of the stiffness matrix");
  }
  factorize_numerically(session_, matrix, factor_.get());
  // CHOLMOD would do this at the first downdate; doing it here keeps it out of the events.
  if (!cholmod_change_factor(CHOLMOD_REAL, false, false, false, true, factor_.get(),
                             session_.get())) {
    throw SolverError("out of memory while turning the factor into a simplicial one");
  }
  ++factorizations_;
}

void CholmodUpdownFactor::solve(std::span<const double> rhs, std::span<double> solution) {
  std::vector<double> copy(rhs.begin(), rhs.end());
  cholmod_dense b = view_column(copy);
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_.get(), &b, session_.get());
  if (x == nullptr) throw SolverError("out of memory while solving");
  std::copy_n(static_cast<const double*>(x->x), solution.size(), solution.begin());
  cholmod_free_dense(&x, session_.get());
}

void CholmodUpdownFactor::follow_load(std::span<const double> load, std::span<double> solution) {
  std::vector<double> permuted(load.size());
  for (std::size_t k = 0; k < load.size(); ++k) permuted[position_[k]] = load[k];
  cholmod_dense b = view_column(permuted);
  cholmod_dense* y = cholmod_solve(CHOLMOD_L, factor_.get(), &b, session_.get());
  if (y == nullptr) throw SolverError("out of memory while solving");
  const double* values = static_cast<const double*>(y->x);
  forward_.assign(values, values + load.size());
  cholmod_free_dense(&y, session_.get());
  backward(solution);
}

/// solution = P' (D L')^-1 forward_
void CholmodUpdownFactor::backward(std::span<double> solution) {
  cholmod_dense y = view_column(forward_);
  cholmod_dense* u = cholmod_solve(CHOLMOD_DLt, factor_.get(), &y, session_.get());
  if (u == nullptr) throw SolverError("out of memory while solving");
  const double* values = static_cast<const double*>(u->x);
  for (std::size_t k = 0; k < solution.size(); ++k) solution[k] = values[position_[k]];
  cholmod_free_dense(&u, session_.get());
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

FactorStatistics CholmodUpdownFactor::statistics() const {
  FactorStatistics result;
  if (!factor_) return result;
  result.size = static_cast<Index>(factor_->n);
  result.entries = static_cast<double>(factor_->nzmax);
  result.bytes = 12.0 * result.entries;
  result.flops = flops_;
  result.factorizations = factorizations_;
  return result;
}

}  // namespace perilink
