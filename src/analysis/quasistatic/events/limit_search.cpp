#include "analysis/quasistatic/events/limit_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/quasistatic/events/block_search.hpp"
#include "base/lanes.hpp"

namespace perilink {
namespace {

/// Fewer blocks than this are searched faster by one thread.
constexpr Index fewest_parallel_bonds = 400;

constexpr const char* no_crushing =
    "elements that only stretch have no teeth in compression of their own";

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

/// Zero without a limit.
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
  const auto largest_in = [&](Index begin, Index end) {
    return largest_between<Dim, sense>(group, u, begin, end);
  };
  const auto find_with = [&](auto& dozing) {
    return find_first_largest(
        group.elements, group.block_largest, dozing, 1.0 - tolerance, threads,
        fewest_parallel_bonds, largest_in,
        [&](Index place) { return ratio_at<Dim, sense>(group, u, place); }, largest_in);
  };
  if (!group.by_columns.any()) return find_with(group.dozing);
  group.by_columns.follow();
  return find_with(group.by_columns);
}

template <int Dim>
LimitSearch::Hit LimitSearch::find_in_all(const double* u, double tolerance, int threads) {
  const Hit pulled = find_in<Dim, Sense::tension>(pulled_, u, tolerance, threads);
  if (strained_.elements.empty()) return pulled;
  const Hit strained = find_in<Dim, Sense::both>(strained_, u, tolerance, threads);
  const Hit& larger = pulled.ratio > strained.ratio ? pulled : strained;
  const double apart = std::abs(pulled.ratio - strained.ratio);
  if (larger.element == no_index || apart > 2.0 * tolerance * larger.ratio) return larger;
  // A tie across the groups: one threshold for both.
  pulled_.dozing.look_everywhere();
  strained_.dozing.look_everywhere();
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
  const auto square_of_gradient = [&] {
    double square = 0.0;
    for (int a = 0; a < dim_; ++a) square += group.gradient[a][place] * group.gradient[a][place];
    return square;
  };
  const double before = square_of_gradient();
  set_gradient(group, place, limit);
  group.dozing.wake(place);
  group.by_columns.wake(static_cast<Index>(place) / search_block_size,
                        square_of_gradient() > before);
}

std::vector<std::uint8_t> LimitSearch::doze(const EmbeddedParticles& embedded) {
  std::vector<std::uint8_t> awake(static_cast<std::size_t>(network_.particles.size()), 0);
  for (Group* group : {&pulled_, &strained_}) {
    const auto slope_of = [&](std::size_t place, double across, double) -> Slope {
      double square = 0.0;
      for (int a = 0; a < dim_; ++a) square += std::pow(group->gradient[a][place], 2);
      return {across * std::sqrt(square), 0.0};
    };
    group->dozing =
        DozingBlocks(network_, embedded, group->elements, search_block_size, false, slope_of);
    group->dozing.mark_awake(network_, group->elements, awake);
  }
  return awake;
}

bool LimitSearch::doze_by_columns(const DeferredMotion& motion) {
  if (!strained_.elements.empty()) return false;  // ties across groups look at all
  const Group& group = pulled_;
  const auto places_of = [&group](Index block) {
    const std::size_t begin = static_cast<std::size_t>(block) * search_block_size;
    return std::pair(begin, std::min(begin + search_block_size, group.elements.size()));
  };
  pulled_.by_columns = DozingColumns(
      motion, static_cast<Index>(group.block_largest.size()), dim_,
      [this, places_of](Index block, const double* columns) {
        const auto [begin, end] = places_of(block);
        return largest_of_columns(begin, end, columns);
      },
      [&group, places_of](Index block, const std::function<void(std::size_t)>& visit) {
        const auto [begin, end] = places_of(block);
        for (std::size_t k = begin; k < end; ++k) {
          visit(group.first[k]);
          visit(group.second[k]);
        }
      });
  return true;
}

std::array<double, block_width> LimitSearch::largest_of_columns(std::size_t begin, std::size_t end,
                                                                const double* columns) const {
  const Group& group = pulled_;
  // Comparisons of vectors that are longer than registers are made one number at a time.
  constexpr int in_register = lanes_of<double>(block_width), count = block_width / in_register;
  using Part = Lanes<double, in_register>;
  using InMemory = LanesInMemory<double, in_register>;
  const auto motion_at = [columns](Index slot) {
    return reinterpret_cast<const InMemory*>(columns +
                                             static_cast<std::size_t>(slot) * block_width);
  };
  Part most[count] = {}, zero_times_all[count] = {};
  for (std::size_t k = begin; k < end; ++k) {
    const InMemory* first = motion_at(group.first[k]);
    const InMemory* second = motion_at(group.second[k]);
    Part ratio[count] = {};
    for (int a = 0; a < dim_; ++a) {
      for (int c = 0; c < count; ++c) ratio[c] += group.gradient[a][k] * (*second++ - *first++);
    }
    for (int c = 0; c < count; ++c) {
      const Part size = ratio[c] < 0.0 ? -ratio[c] : ratio[c];
      most[c] = size > most[c] ? size : most[c];
      zero_times_all[c] += 0.0 * size;
    }
  }
  std::array<double, block_width> result;
  for (int c = 0; c < block_width; ++c) {
    const int lanes = c / in_register, lane = c % in_register;
    result[c] = largest_or_nan(most[lanes][lane], zero_times_all[lanes][lane]);
  }
  return result;
}

void LimitSearch::set_limits(Index /*element*/, double /*tension*/, double /*compression*/) {
  throw std::logic_error(no_crushing);
}

}  // namespace perilink
