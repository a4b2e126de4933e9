#include "solver/factor.hpp"

#include <algorithm>
#include <vector>

namespace perilink {

void Factor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  std::vector<double> direction(static_cast<std::size_t>(statistics().size));
  for (std::size_t b = 0; b < x.size(); ++b) {
    std::fill(direction.begin(), direction.end(), 0.0);
    for (int k = 0; k < x[b].size(); ++k) direction[x[b].rows[k]] = x[b].values[k];
    solve(direction, direction);
    for (std::size_t a = 0; a < x.size(); ++a) {
      double sum = 0.0;
      for (int k = 0; k < x[a].size(); ++k) sum += x[a].values[k] * direction[x[a].rows[k]];
      result[a * x.size() + b] = sum;
    }
  }
}

void Factor::downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                      std::span<const double> /*pivots*/, std::span<double> solution) {
  for (std::size_t a = 0; a < x.size(); ++a) {
    prepare_downdate(x[a]);
    commit_downdate(load_changes[a], solution);
  }
}

}  // namespace perilink
