#include "solver/factor.hpp"

#include <algorithm>
#include <stdexcept>

namespace perilink {

double Factor::pivot(const SparseVector& x) {
  double removed = 0.0;
  compliance({&x, 1}, {&removed, 1});
  return 1.0 - removed;
}

double Factor::downdate_together(std::span<const SparseVector> x) {
  constexpr double no_load_change = 0.0;
  double smallest = 1.0;
  for (const SparseVector& vector : x) {
    const double left = pivot(vector);
    if (!(left > 0.0)) return 0.0;
    downdate({&vector, 1}, {&no_load_change, 1}, {&left, 1}, {});
    smallest = std::min(smallest, left);
  }
  return smallest;
}

double Factor::path_of(std::span<const SparseVector> x) const {
  return static_cast<double>(x.size()) * statistics().entries;
}

void Factor::add_solution(const SparseVector& b, std::span<double> solution) {
  std::vector<double> change(solution.size(), 0.0);
  for (int k = 0; k < b.size(); ++k) change[b.rows[k]] = b.values[k];
  solve(change, change);
  for (std::size_t k = 0; k < change.size(); ++k) solution[k] += change[k];
}

void Factor::solve_all(std::span<double> columns) {
  const auto size = static_cast<std::size_t>(statistics().size);
  for (std::size_t begin = 0; begin < columns.size(); begin += size) {
    const std::span<double> column = columns.subspan(begin, size);
    solve(column, column);
  }
}

SingleFactor Factor::in_single(double /*unit*/) const {
  throw std::logic_error("the factor is not made of supernodes that can be copied");
}

SparseVector combine(std::span<const SparseVector> x, std::span<const double> weights) {
  SparseVector sum;
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (int k = 0; k < x[a].size(); ++k) sum.add(x[a].rows[k], weights[a] * x[a].values[k]);
  }
  return sum;
}

std::vector<double> extensions(std::span<const SparseVector> x,
                               std::span<const double> load_changes, std::span<const double> u) {
  std::vector<double> result(load_changes.begin(), load_changes.end());
  for (std::size_t a = 0; a < x.size(); ++a) {
    for (int k = 0; k < x[a].size(); ++k) result[a] += x[a].values[k] * u[x[a].rows[k]];
  }
  return result;
}

}  // namespace perilink
