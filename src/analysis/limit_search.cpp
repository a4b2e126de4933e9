#include "analysis/limit_search.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

constexpr Index block_size = 512;
/// Fewer blocks than this are searched faster by one thread.
constexpr Index smallest_parallel_search = 400;

}  // namespace

LimitSearch::LimitSearch(const Network& network) : dim_(network.dim()) {
  for (Index e = 0; e < network.num_elements(); ++e) {
    const double limit = network.critical_stretch[e];
    if (!std::isfinite(limit)) continue;
    elements_.push_back(e);
    first_.push_back(network.bonds.first[e] * dim_);
    second_.push_back(network.bonds.second[e] * dim_);
    const std::span<const double> n = network.bonds.direction(e);
    for (int a = 0; a < dim_; ++a) {
      gradient_[a].push_back(n[a] / (network.bonds.lengths[e] * limit));
    }
  }
  block_largest_.resize((elements_.size() + block_size - 1) / block_size);
}

template <int Dim>
double LimitSearch::largest_in_block(const double* u, Index block) const {
  const Index begin = block * block_size;
  const Index end = std::min<Index>(begin + block_size, static_cast<Index>(elements_.size()));
  const Index* first = first_.data();
  const Index* second = second_.data();
  const double* gx = gradient_[0].data();
  const double* gy = gradient_[1].data();
  const double* gz = gradient_[2].data();
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (Index k = begin; k < end; ++k) {
    const Index i = first[k];
    const Index j = second[k];
    double ratio = gx[k] * (u[j] - u[i]) + gy[k] * (u[j + 1] - u[i + 1]);
    if constexpr (Dim == 3) ratio += gz[k] * (u[j + 2] - u[i + 2]);
    largest = ratio > largest ? ratio : largest;
  }
  return largest;
}

template <int Dim>
LimitSearch::Hit LimitSearch::find_in(const double* u, double tolerance, int threads) {
  const Index blocks = static_cast<Index>(block_largest_.size());
#pragma omp parallel for schedule(static) num_threads(threads) \
    if (threads > 1 && blocks > smallest_parallel_search)
  for (Index b = 0; b < blocks; ++b) block_largest_[b] = largest_in_block<Dim>(u, b);

  double largest = 0.0;
  for (const double value : block_largest_) largest = std::max(largest, value);
  if (largest <= 0.0) return {};
  const double threshold = largest * (1.0 - tolerance);
  for (Index b = 0; b < blocks; ++b) {
    if (block_largest_[b] < threshold) continue;
    const Index end = std::min<Index>((b + 1) * block_size, static_cast<Index>(elements_.size()));
    for (Index k = b * block_size; k < end; ++k) {
      double ratio = 0.0;
      for (int a = 0; a < Dim; ++a) {
        ratio += gradient_[a][k] * (u[second_[k] + a] - u[first_[k] + a]);
      }
      // The sum above may be rounded otherwise than in the vector loop: the tolerance covers both.
      if (ratio >= threshold * (1.0 - 1e-14)) return {elements_[k], ratio};
    }
  }
  return {};
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
