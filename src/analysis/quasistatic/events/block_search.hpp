#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"
#include "base/types.hpp"

namespace perilink {

/// Number of elements that a search processes at once.
inline constexpr Index search_block_size = 512;

inline std::size_t num_search_blocks(std::size_t num_elements) {
  return (num_elements + search_block_size - 1) / search_block_size;
}

/// Returns the largest value of a block, or not-a-number if one of its values is not finite.
/// Comparisons skip such values.
/// \param zero_times_all  sum of zero times every value
inline double largest_or_nan(double largest, double zero_times_all) {
  return zero_times_all == 0.0 ? largest : std::numeric_limits<double>::quiet_NaN();
}

/// Finds the first element whose value reaches `share` of the largest positive value. A first pass
/// finds the largest value of every block, in parallel. A second one finds the first element in
/// blocks that reach the threshold. The result does not depend on the number of threads.
/// \param elements          element of each position
/// \param block_largest     work space, one entry per block
/// \param fewest_parallel   number of blocks above which several threads are faster than one
/// \param largest_in        returns the largest value of positions [begin, end), see
///                          largest_or_nan()
/// \param value_at          returns the value of one position
/// \throws SolverError if a value is not finite
template <typename LargestIn, typename ValueAt>
BreakSearch::Hit find_first_largest(const std::vector<Index>& elements,
                                    std::vector<double>& block_largest, double share, int threads,
                                    Index fewest_parallel, const LargestIn& largest_in,
                                    const ValueAt& value_at) {
  const Index count = static_cast<Index>(elements.size());
  const Index blocks = static_cast<Index>(block_largest.size());
  const auto end_of = [count](Index block) {
    return std::min<Index>((block + 1) * search_block_size, count);
  };
#pragma omp parallel for schedule(static) \
    num_threads(threads) if (threads > 1 && blocks > fewest_parallel)
  for (Index b = 0; b < blocks; ++b) {
    block_largest[b] = largest_in(b * search_block_size, end_of(b));
  }
  double largest = 0.0;
  for (Index b = 0; b < blocks; ++b) {
    if (!std::isfinite(block_largest[b])) {
      for (Index k = b * search_block_size; k < end_of(b); ++k) {
        finite_ratio(elements[k], value_at(k));
      }
    }
    largest = std::max(largest, block_largest[b]);
  }
  if (largest <= 0.0) return {};
  // The two passes may round differently.
  const double threshold = largest * share * (1.0 - 1e-14);
  for (Index b = 0; b < blocks; ++b) {
    if (block_largest[b] < threshold) continue;
    for (Index k = b * search_block_size; k < end_of(b); ++k) {
      const double value = value_at(k);
      if (value >= threshold) return {elements[k], value};
    }
  }
  return {};
}

}  // namespace perilink
