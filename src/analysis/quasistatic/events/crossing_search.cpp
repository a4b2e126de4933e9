#include "analysis/quasistatic/events/crossing_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/quasistatic/events/block_search.hpp"
#include "analysis/quasistatic/events/break_search.hpp"
#include "network/frame.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

/// Axial stretch over its limit above which a bond that bends counts as stretched [-]. Where
/// symmetry keeps its length, round-off must not decide.
constexpr double least_stretch = 1e-6;

/// Number of blocks below which one thread is faster.
constexpr Index fewest_parallel_crossings = 100;

/// Parts of the stretch over its limit whose squares add up, the axial part first.
template <int Dim, bool Turns>
struct Measure {
  static constexpr int size = !Turns ? 1 : Dim == 2 ? 3 : 8;
  double part[size];

  double times(const Measure& other) const {
    double sum = 0.0;
    for (int k = 0; k < size; ++k) sum += part[k] * other.part[k];
    return sum;
  }
};

}  // namespace

CrossingSearch::Query::Query(const Network& network, std::span<const double> present,
                             std::span<const double> added, double direction, double within,
                             bool asks_for_largest)
    : now(present.data()),
      growing(added.data()),
      sense(direction),
      tolerance(within),
      largest(asks_for_largest) {
  noise = motion_round_off * largest_displacement(network, added);
}

/// Returns whether the low end of the interval may be the answer.
bool CrossingSearch::Query::asks_for(const Interval& interval) const {
  if (interval.low == -infinity) return false;
  return largest ? interval.high == infinity : interval.low >= -interval.margin;
}

void CrossingSearch::Found::need(double distance, Index element) {
  if (!(distance > needed)) return;
  needed = distance;
  needing = element;
}

void CrossingSearch::Found::add(const Found& other) {
  low = std::min(low, other.low);
  early = std::min(early, other.early);
  need(other.needed, other.needing);
  lost = std::min(lost, other.lost);
  islands.insert(islands.end(), other.islands.begin(), other.islands.end());
}

CrossingSearch::CrossingSearch(const Network& network)
    : network_(network),
      dim_(network.dim()),
      turns_(network.carries_moments()),
      torsion_(network.torsion) {
  const int width = network.width();
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.has_limit(e)) continue;
    Element element{};
    element.number = e;
    element.first = network.bonds.first[e] * width;
    element.second = network.bonds.second[e] * width;
    for (int a = 0; a < dim_; ++a) element.n[a] = network.bonds.direction(e)[a];
    const double length = network.bonds.length(e);
    if (turns_) {
      element.first_arm = network.inflection_of(e) * length;
      element.second_arm = (1.0 - network.inflection_of(e)) * length;
      element.shear_share = std::sqrt(network.ratio_of_bending(e));
      element.rotation_share =
          network.is_hinged(e) ? 0.0 : element.shear_share * length / std::sqrt(12.0);
    }
    element.length = length;
    element.inverse =
        1.0 / (length * network.critical_stretch[e] * network.law(e).segment(0).limit);
    element.both = network.law(e).sense() == Sense::both;
    elements_.push_back(element);
  }
  blocks_.resize(num_search_blocks(elements_.size()));
}

namespace {

template <int Dim, bool Turns, class Element>
Measure<Dim, Turns> measure(const Element& bond, const double* u, double scale, double torsion) {
  const double* i = u + bond.first;
  const double* j = u + bond.second;
  Measure<Dim, Turns> result{};
  if constexpr (Turns) {
    const FrameDeformation<Dim> d(bond.n, bond.first_arm, bond.second_arm, i, j);
    double* part = result.part;
    *part++ = d.extension;
    for (int a = 0; a < (Dim == 2 ? 1 : 3); ++a) *part++ = bond.shear_share * d.shear[a];
    for (const double bend : d.bend) *part++ = bond.rotation_share * bend;
    if constexpr (Dim == 3) *part = bond.rotation_share * std::sqrt(torsion) * d.twist;
  } else {
    for (int a = 0; a < Dim; ++a) result.part[0] += bond.n[a] * (j[a] - i[a]);
  }
  for (double& part : result.part) part *= scale;
  return result;
}

}  // namespace

template <int Dim>
bool CrossingSearch::is_noise(const Element& element, const double* motion, double extension) {
  double size = 0.0;
  for (int a = 0; a < Dim; ++a) {
    const double ends = std::abs(motion[element.first + a]) + std::abs(motion[element.second + a]);
    size += std::abs(element.n[a]) * ends;
  }
  return std::abs(extension) <= motion_round_off * size;
}

template <int Dim, bool Turns, class Sink>
void CrossingSearch::visit(const Element& element, const Query& query, Sink&& sink) const {
  if (element.inverse == 0.0) return;
  const auto now = measure<Dim, Turns>(element, query.now, element.inverse, torsion_);
  auto growing =
      measure<Dim, Turns>(element, query.growing, query.sense * element.inverse, torsion_);
  const double extension = growing.part[0] / element.inverse;
  constexpr double most_of_ends = 6.0;  // two ends, three components
  if (growing.times(growing) <= std::pow(query.noise * element.inverse, 2)) {
    growing = {};
  } else if (std::abs(extension) <= most_of_ends * query.noise &&
             is_noise<Dim>(element, query.growing, extension)) {
    growing.part[0] = 0.0;
  }
  const double square = now.times(now), rate = growing.times(growing);
  if (!std::isfinite(square + rate)) return sink(Interval{infinity, -infinity, 0.0});
  const double margin = rate > 0.0 ? query.tolerance / std::sqrt(rate) : 0.0;
  const double stretch = now.part[0], stretching = growing.part[0];
  double low = -infinity, high = infinity;  // between them the element is within its limit
  bool never = false;                       // never within its limit
  if (rate == 0.0) {
    never = square > 1.0 + 2.0 * query.tolerance;
  } else if constexpr (!Turns) {
    const double one = (1.0 - stretch) / stretching, other = (-1.0 - stretch) / stretching;
    low = std::min(one, other);
    high = std::max(one, other);
  } else {
    const double half = now.times(growing);
    const double rest = half * half - rate * (square - 1.0);
    never = !(rest > 0.0);
    const double sum = half >= 0.0 ? -(half + std::sqrt(rest)) : std::sqrt(rest) - half;
    if (!never) std::tie(low, high) = std::minmax({sum / rate, (square - 1.0) / sum});
  }
  // Interval in which the element is stretched, if it fails in tension only.
  double from = -infinity, to = infinity;
  if (!element.both) {
    const double least = Turns ? least_stretch : 0.0;
    if (stretching > 0.0) {
      from = (least - stretch) / stretching;
    } else if (stretching < 0.0) {
      to = (least - stretch) / stretching;
    } else if (!(stretch > least)) {
      return;
    }
  }
  if (never) return sink(Interval{from, to, margin});
  const Interval above{std::max(high, from), to, margin};
  const Interval below{from, std::min(low, to), margin};
  if (above.low < above.high) sink(above);
  if (below.low < below.high) sink(below);
}

template <class Sink>
void CrossingSearch::visit(std::size_t place, const Query& query, Sink&& sink) const {
  const Element& element = elements_[place];
  if (dim_ == 3) {
    turns_ ? visit<3, true>(element, query, sink) : visit<3, false>(element, query, sink);
  } else {
    turns_ ? visit<2, true>(element, query, sink) : visit<2, false>(element, query, sink);
  }
}

auto CrossingSearch::find(const Query& query, int threads) -> Found {
  const Index blocks = static_cast<Index>(blocks_.size());
#pragma omp parallel for schedule(static) \
    num_threads(threads) if (threads > 1 && blocks > fewest_parallel_crossings)
  for (Index b = 0; b < blocks; ++b) {
    Found found;
    const std::size_t begin = static_cast<std::size_t>(b) * search_block_size;
    const std::size_t end = std::min(begin + search_block_size, elements_.size());
    for (std::size_t k = begin; k < end; ++k) {
      // Inlined wherever the compiler's limits end: all elements pass here at every event.
      visit(
          k, query, [&](const Interval& interval) __attribute__((always_inline)) {
            if (interval.low > interval.high) {
              found.lost = std::min(found.lost, elements_[k].number);
            } else if (query.asks_for(interval)) {
              found.low = std::min(found.low, interval.low);
              found.early = std::min(found.early, interval.low - interval.margin);
            } else if (query.largest && interval.low == -infinity) {
              found.need(interval.high - interval.margin, elements_[k].number);
            } else if (query.largest) {
              found.islands.push_back({interval, elements_[k].number});
            }
          });
    }
    blocks_[b] = std::move(found);
  }
  Found all;
  for (const Found& block : blocks_) all.add(block);
  if (all.lost < std::numeric_limits<Index>::max()) {
    finite_ratio(all.lost, std::numeric_limits<double>::quiet_NaN());
  }
  return all;
}

/// Returns the lowest element that passes its limit at d, or comes within its margin.
Index CrossingSearch::element_at(double distance, const Query& query) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (blocks_[b].early > distance) continue;
    const std::size_t begin = b * search_block_size;
    const std::size_t end = std::min(begin + search_block_size, elements_.size());
    for (std::size_t k = begin; k < end; ++k) {
      bool found = false;
      visit(k, query, [&](const Interval& interval) {
        found |= query.asks_for(interval) && interval.low - interval.margin <= distance;
      });
      if (found) return elements_[k].number;
    }
  }
  return no_index;
}

auto CrossingSearch::ahead(std::span<const double> now, std::span<const double> growing, int sense,
                           double tolerance, int threads) -> Crossing {
  const Query query(network_, now, growing, sense, tolerance, false);
  const Found found = find(query, threads);
  if (found.low == infinity) return {};
  return {element_at(found.low, query), sense * std::max(found.low, 0.0)};
}

auto CrossingSearch::largest(std::span<const double> now, std::span<const double> growing,
                             double tolerance, int threads) -> Crossing {
  const Query query(network_, now, growing, 1.0, tolerance, true);
  const Found found = find(query, threads);
  double distance = found.low;
  Index element = no_index;
  std::vector<Index> passed;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Found::Island& island : found.islands) {
      const Interval& within = island.interval;
      if (distance - within.low <= within.margin || within.high - distance <= within.margin)
        continue;
      distance = within.low;
      element = island.element;
      passed.push_back(element);
      moved = true;
    }
  }
  if (distance < found.needed) {
    passed.push_back(found.needing);
    if (found.low < infinity) passed.push_back(element_at(found.low, query));
    return {no_index, -infinity, std::move(passed)};
  }
  if (element == no_index && distance < infinity) element = element_at(distance, query);
  return {element, distance};
}

void CrossingSearch::set_limit(Index element, double limit) {
  const auto found =
      std::lower_bound(elements_.begin(), elements_.end(), element,
                       [](const Element& entry, Index number) { return entry.number < number; });
  if (found == elements_.end() || found->number != element) return;
  found->inverse = std::isinf(limit) ? 0.0 : 1.0 / (found->length * limit);
}

}  // namespace perilink
