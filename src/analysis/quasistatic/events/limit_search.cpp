#include "analysis/quasistatic/events/limit_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/quasistatic/events/block_search.hpp"

namespace perilink {
namespace {

/// Number of blocks below which one thread is faster.
constexpr Index fewest_parallel_bonds = 400;

constexpr const char* no_crushing = "truss elements have no segments of their own in compression";

}  // namespace

LimitSearch::LimitSearch(const Network& network) : network_(network), dim_(network.dim()) {
  if (network.has_crushing()) throw std::invalid_argument(no_crushing);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.has_limit(e)) continue;
    add(e, network.law(e).sense() == Sense::both ? strained_ : pulled_);
  }
  for (Group* group : {&pulled_, &strained_}) {
    group->block_largest.resize(num_search_blocks(group->elements.size()));
  }
}

void LimitSearch::add(Index element, Group& group) {
  group.elements.push_back(element);
  group.first.push_back(network_.bonds.first[element] * dim_);
  group.second.push_back(network_.bonds.second[element] * dim_);
  for (int a = 0; a < dim_; ++a) group.gradient[a].push_back(0.0);
  set_gradient(group, group.elements.size() - 1,
               network_.critical_stretch[element] * network_.law(element).segment(0).limit);
}

/// Sets the gradient of an element; zero without a limit.
void LimitSearch::set_gradient(Group& group, std::size_t place, double limit) {
  const Index element = group.elements[place];
  const std::span<const double> n = network_.bonds.direction(element);
  for (int a = 0; a < dim_; ++a) {
    group.gradient[a][place] =
        std::isinf(limit) ? 0.0 : n[a] / (network_.bonds.length(element) * limit);
  }
}

template <int Dim, Sense sense>
double LimitSearch::largest_between(const Group& group, const double* u, Index begin, Index end) {
  const Index* first = group.first.data();
  const Index* second = group.second.data();
  const double* gx = group.gradient[0].data();
  const double* gy = group.gradient[1].data();
  const double* gz = group.gradient[2].data();
  double largest = 0.0, zero_times_all = 0.0;
#pragma omp simd reduction(max : largest) reduction(+ : zero_times_all)
  for (Index k = begin; k < end; ++k) {
    const Index i = first[k];
    const Index j = second[k];
    double ratio = gx[k] * (u[j] - u[i]) + gy[k] * (u[j + 1] - u[i + 1]);
    if constexpr (Dim == 3) ratio += gz[k] * (u[j + 2] - u[i + 2]);
    if constexpr (sense == Sense::both) ratio = std::abs(ratio);
    largest = ratio > largest ? ratio : largest;
    zero_times_all += 0.0 * ratio;
  }
  return largest_or_nan(largest, zero_times_all);
}

template <int Dim, Sense sense>
double LimitSearch::ratio_at(const Group& group, const double* u, Index place) {
  double ratio = 0.0;
  for (int a = 0; a < Dim; ++a) {
    ratio += group.gradient[a][place] * (u[group.second[place] + a] - u[group.first[place] + a]);
  }
  return sense == Sense::both ? std::abs(ratio) : ratio;
}

template <int Dim, Sense sense>
LimitSearch::Hit LimitSearch::find_in(Group& group, const double* u, double tolerance,
                                      int threads) {
  return find_first_largest(
      group.elements, group.block_largest, 1.0 - tolerance, threads, fewest_parallel_bonds,
      [&](Index begin, Index end) { return largest_between<Dim, sense>(group, u, begin, end); },
      [&](Index place) { return ratio_at<Dim, sense>(group, u, place); });
}

template <int Dim>
LimitSearch::Hit LimitSearch::find_in_all(const double* u, double tolerance, int threads) {
  const Hit pulled = find_in<Dim, Sense::tension>(pulled_, u, tolerance, threads);
  if (strained_.elements.empty()) return pulled;
  const Hit strained = find_in<Dim, Sense::both>(strained_, u, tolerance, threads);
  const Hit& larger = pulled.ratio > strained.ratio ? pulled : strained;
  const double apart = std::abs(pulled.ratio - strained.ratio);
  if (larger.element == no_index || apart > 2.0 * tolerance * larger.ratio) return larger;
  // The groups tie: one threshold serves both.
  const std::span<const double> all(u, network_.particles.positions.size());
  const std::vector<Hit> hits = list(all, larger.ratio * (1.0 - 2.0 * tolerance));
  double largest = 0.0;
  for (const Hit& hit : hits) largest = std::max(largest, hit.ratio);
  for (const Hit& hit : hits) {
    if (hit.ratio >= largest * (1.0 - tolerance)) return hit;
  }
  return larger;
}

LimitSearch::Hit LimitSearch::find(std::span<const double> displacement, double tolerance,
                                   int threads) {
  return dim_ == 3 ? find_in_all<3>(displacement.data(), tolerance, threads)
                   : find_in_all<2>(displacement.data(), tolerance, threads);
}

std::vector<LimitSearch::Hit> LimitSearch::list(std::span<const double> displacement,
                                                double least) const {
  const double* u = displacement.data();
  std::vector<Hit> hits;
  const auto add_all = [&](const Group& group, auto ratio) {
    for (std::size_t k = 0; k < group.elements.size(); ++k) {
      const double value = finite_ratio(group.elements[k], ratio(group, u, static_cast<Index>(k)));
      if (value >= least) hits.push_back({group.elements[k], value});
    }
  };
  add_all(pulled_, dim_ == 3 ? ratio_at<3, Sense::tension> : ratio_at<2, Sense::tension>);
  add_all(strained_, dim_ == 3 ? ratio_at<3, Sense::both> : ratio_at<2, Sense::both>);
  std::sort(hits.begin(), hits.end(),
            [](const Hit& a, const Hit& b) { return a.element < b.element; });
  return hits;
}

void LimitSearch::set_limit(Index element, double limit) {
  if (!network_.has_limit(element)) return;
  Group& group = network_.law(element).sense() == Sense::both ? strained_ : pulled_;
  const auto found = std::lower_bound(group.elements.begin(), group.elements.end(), element);
  const auto place = static_cast<std::size_t>(found - group.elements.begin());
  set_gradient(group, place, limit);
}

void LimitSearch::set_limits(Index /*element*/, double /*tension*/, double /*compression*/) {
  throw std::logic_error(no_crushing);
}

}  // namespace perilink
