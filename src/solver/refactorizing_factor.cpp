#include "solver/refactorizing_factor.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace perilink {

void RefactorizingFactor::factorize(const SparseMatrix& matrix, std::span<const Index> groups) {
  factor_ = analyze(matrix, groups);
  refactorize(matrix);
}

void RefactorizingFactor::refactorize(const SparseMatrix& matrix) {
  matrix_ = matrix;
  compute(matrix_);
}

void RefactorizingFactor::follow_load(std::span<const double> load, std::span<double> solution) {
  load_.assign(load.begin(), load.end());
  solve(load_, solution);
}

double RefactorizingFactor::prepare_downdate(const SparseVector& x) {
  x_ = x;
  std::vector<double> direction(static_cast<std::size_t>(matrix_.cols()), 0.0);
  for (int k = 0; k < x.size(); ++k) direction[x.rows[k]] = x.values[k];
  solve(direction, direction);
  double removed = 0.0;
  for (int k = 0; k < x.size(); ++k) removed += x.values[k] * direction[x.rows[k]];
  return 1.0 - removed;
}

/// Adds sign * x x' to the lower triangle.
void RefactorizingFactor::change_matrix(const SparseVector& x, double sign) {
  for (int a = 0; a < x.size(); ++a) {
    for (int b = 0; b < x.size(); ++b) {
      if (x.rows[a] < x.rows[b]) continue;
      const Index* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[x.rows[b]];
      const Index* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[x.rows[b] + 1];
      const Index* entry = std::lower_bound(begin, end, x.rows[a]);
      if (entry == end || *entry != x.rows[a]) {
        throw SolverError("a change of the stiffness matrix lies outside its pattern");
      }
      matrix_.valuePtr()[entry - matrix_.innerIndexPtr()] += sign * x.values[a] * x.values[b];
    }
  }
}

void RefactorizingFactor::add_to_load(const SparseVector& x, double factor) {
  for (int k = 0; k < x.size(); ++k) load_[x.rows[k]] += factor * x.values[k];
}

void RefactorizingFactor::commit_downdate(double load_change, std::span<double> solution) {
  downdate({&x_, 1}, {&load_change, 1}, {}, solution);
}

void RefactorizingFactor::downdate(std::span<const SparseVector> x,
                                   std::span<const double> load_changes,
                                   std::span<const double> /*pivots*/, std::span<double> solution) {
  for (std::size_t a = 0; a < x.size(); ++a) {
    change_matrix(x[a], -1.0);
    add_to_load(x[a], load_changes[a]);
  }
  compute(matrix_);
  solve(load_, solution);
}

void RefactorizingFactor::update(const SparseVector& x, std::span<const double> solution) {
  change_matrix(x, 1.0);
  double extension = 0.0;
  for (int k = 0; k < x.size(); ++k) extension += x.values[k] * solution[x.rows[k]];
  add_to_load(x, extension);
  compute(matrix_);
}

}  // namespace perilink
