#include "analysis/quasistatic/events/limit_search.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/events/block_search.hpp"

namespace perilink {
namespace {

/// Fewer blocks than this are searched faster by one thread.
constexpr Index smallest_parallel_search = 400;

}  // namespace

LimitSearch::LimitSearch(const Network& network) : dim_(network.dim()) {
  for (Index e = 0; e < network.num_elements(); ++e) {
    const double limit = network.critical_stretch[e];
    if (std::isinf(limit)) continue;
    elements_.push_back(e);
    first_.push_back(network.bonds.first[e] * dim_);
    second_.push_back(network.bonds.second[e] * dim_);
    const std::span<const double> n = network.bonds.direction(e);
    for (int a = 0; a < dim_; ++a) {
      gradient_[a].push_back(n[a] / (network.bonds.lengths[e] * limit));
    }
  }
  block_largest_.resize(num_search_blocks(elements_.size()));
}

template <int Dim>
double LimitSearch::largest_between(const double* u, Index begin, Index end) const {
  const Index* first = first_.data();
  const Index* second = second_.data();
  const double* gx = gradient_[0].data();
  const double* gy = gradient_[1].data();
  const double* gz = gradient_[2].data();
  double largest = 0.0, zero_times_all = 0.0;
#pragma omp simd reduction(max : largest) reduction(+ : zero_times_all)
  for (Index k = begin; k < end; ++k) {
    const Index i = first[k];
    const Index j = second[k];
    double ratio = gx[k] * (u[j] - u[i]) + gy[k] * (u[j + 1] - u[i + 1]);
    if constexpr (Dim == 3) ratio += gz[k] * (u[j + 2] - u[i + 2]);
    largest = ratio > largest ? ratio : largest;
    zero_times_all += 0.0 * ratio;
  }
  return largest_or_nan(largest, zero_times_all);
}

template <int Dim>
LimitSearch::Hit LimitSearch::find_in(const double* u, double tolerance, int threads) {
  const auto ratio_at = [&](Index k) {
    double ratio = 0.0;
    for (int a = 0; a < Dim; ++a) ratio += gradient_[a][k] * (u[second_[k] + a] - u[first_[k] + a]);
    return ratio;
  };
  return find_first_largest(
      elements_, block_largest_, 1.0 - tolerance, threads, smallest_parallel_search,
      [&](Index begin, Index end) { return largest_between<Dim>(u, begin, end); }, ratio_at);
}

LimitSearch::Hit LimitSearch::find(std::span<const double> displacement, double tolerance,
                                   int threads) {
  return dim_ == 3 ? find_in<3>(displacement.data(), tolerance, threads)
                   : find_in<2>(displacement.data(), tolerance, threads);
}

void LimitSearch::remove(Index element) {
  const auto found = std::lower_bound(elements_.begin(), elements_.end(), element);
  if (found == elements_.end() || *found != element) return;
  for (int a = 0; a < dim_; ++a) gradient_[a][found - elements_.begin()] = 0.0;
}

}  // namespace perilink
