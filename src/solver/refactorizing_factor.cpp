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

void RefactorizingFactor::downdate(std::span<const SparseVector> x,
                                   std::span<const double> load_changes,
                                   std::span<const double> /*pivots*/, std::span<double> solution) {
  for (const SparseVector& column : x) change_matrix(column, -1.0);
  compute(matrix_);
  follow(x, load_changes, solution);
}

void RefactorizingFactor::update(const SparseVector& x) {
  change_matrix(x, 1.0);
  compute(matrix_);
}

}  // namespace perilink
