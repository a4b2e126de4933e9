// Changes of a factor by many vectors; each pass over L serves up to most_together of them.

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "solver/in_place_factor.hpp"
#include "solver/supernodes/supernodal_kernels.hpp"

namespace perilink {

/// Adds the supernodes from the column's one to the root to the path, unsorted.
void InPlaceFactor::add_to_path(Index column) {
  for (Index s = tree_.of_column[column]; s != no_index && !on_path_[s]; s = tree_.parent[s]) {
    path_.push_back(s);
    on_path_[s] = 1;
  }
}

/// \param permuted  at most most_together vectors in the factor's order, none empty
/// \return smallest pivot, as downdate_together()
double InPlaceFactor::change_together(std::span<const SparseVector> permuted) {
  clear_path();
  const auto n = static_cast<std::size_t>(size_);
  for (std::size_t m = 0; m < permuted.size(); ++m) {
    const SparseVector& x = permuted[m];
    for (int k = 0; k < x.size(); ++k) together_[m * n + x.rows[k]] = x.values[k];
    at_supernode_[tree_.of_column[x.rows[0]]] |= 1U << m;
    add_to_path(x.rows[0]);
  }
  std::sort(path_.begin(), path_.end());
  std::vector<double> local(static_cast<std::size_t>(longest_) * permuted.size());
  double sigma[supernodal::most_together];
  std::fill_n(sigma, permuted.size(), -1.0);
  bool positive = true;
  for (const Index s : path_) {
    const Supernode<double> b = block(s);
    const std::uint32_t here = std::exchange(at_supernode_[s], 0U);
    if (tree_.parent[s] != no_index) at_supernode_[tree_.parent[s]] |= here;
    std::size_t vectors[supernodal::most_together];
    double sigmas[supernodal::most_together];
    Index count = 0;
    for (std::uint32_t left = here; left != 0; left &= left - 1) {
      const auto m = static_cast<std::size_t>(std::countr_zero(left));
      double* const from = together_.data() + m * n;
      double* const to = local.data() + static_cast<std::size_t>(count) * b.count;
      std::copy_n(from + b.first, b.columns, to);
      std::fill_n(from + b.first, b.columns, 0.0);
      for (Index r = b.columns; r < b.count; ++r) to[r] = from[b.rows[r]];
      vectors[count] = m;
      sigmas[count++] = sigma[m];
    }
    if (positive) {
      positive =
          supernodal::change_together(b.values, b.count, b.columns, count, local.data(), sigmas);
    }
    for (Index k = 0; k < count; ++k) {
      double* const to = together_.data() + vectors[k] * n;
      const double* const from = local.data() + static_cast<std::size_t>(k) * b.count;
      for (Index r = b.columns; r < b.count; ++r) to[b.rows[r]] = from[r];
      sigma[vectors[k]] = sigmas[k];
    }
  }
  if (!positive) return 0.0;
  double smallest = 1.0;
  for (std::size_t m = 0; m < permuted.size(); ++m) smallest = std::min(smallest, -1.0 / sigma[m]);
  return smallest;
}

double InPlaceFactor::path_of(std::span<const SparseVector> x) const {
  double numbers = 0.0;
  for (const SparseVector& vector : x) {
    Index first = size_;
    for (const Index row : vector.rows) first = std::min(first, position_[row]);
    if (first < size_) numbers += to_root_[tree_.of_column[first]];
  }
  return numbers;
}

double InPlaceFactor::downdate_together(std::span<const SparseVector> x) {
  on_path_of_ = {};
  std::vector<SparseVector> permuted;
  for (const SparseVector& vector : x) {
    if (vector.size() > 0) permuted.push_back(permute(vector, position_));
  }
  // Sort, because neighbours share most of their paths.
  std::stable_sort(permuted.begin(), permuted.end(),
                   [](const auto& a, const auto& b) { return a.rows[0] < b.rows[0]; });
  const std::size_t most = supernodal::most_together;
  together_.resize(most * static_cast<std::size_t>(size_), 0.0);
  double smallest = 1.0;
  for (std::size_t begin = 0; begin < permuted.size(); begin += most) {
    const std::size_t count = std::min(most, permuted.size() - begin);
    smallest = std::min(smallest, change_together(std::span(permuted).subspan(begin, count)));
    if (!(smallest > 0.0)) return 0.0;
  }
  return smallest;
}

void InPlaceFactor::add_solution(const SparseVector& b, std::span<double> solution) {
  clear_path();
  on_path_of_ = {};
  for (int k = 0; k < b.size(); ++k) {
    p_[position_[b.rows[k]]] = b.values[k];
    add_to_path(position_[b.rows[k]]);
  }
  std::sort(path_.begin(), path_.end());
  std::fill(vector_.begin(), vector_.end(), 0.0);
  for (const Index s : path_) {
    forward_on(s, 0, p_.data(), local_.data());
    const Supernode<double> here = block(s);
    for (Index j = 0; is_wanted(s) && j < here.columns; ++j) {
      vector_[here.first + j] = p_[here.first + j] / here.diagonal(j);
    }
  }
  descend(solution_threads_, [this](Index s, double* local) {
    if (is_wanted(s)) backward_on(s, vector_.data(), local);
  });
  for (Index k = 0; k < size_; ++k) solution[k] += vector_[position_[k]];
}

}  // namespace perilink
