#pragma once

#include <algorithm>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Elements that a search looks at in one go.
inline constexpr Index search_block_size = 512;

inline std::size_t num_search_blocks(std::size_t num_elements) {
  return (num_elements + search_block_size - 1) / search_block_size;
}

/// An element among those that are searched.
struct BlockHit {
  Index position = no_index;
  double value = 0.0;
};

/// The largest positive value; of those above `share` of it the first. Two passes: the largest of
/// every block, in parallel, then the first element among the blocks that reach the threshold. The
/// answer does not depend on the number of threads.
/// \param block_largest     work space, one per block
/// \param fewest_parallel   blocks from which on several threads are faster than one
/// \param largest_in        largest value in the positions [begin, end)
/// \param value_at          value at one position
template <typename LargestIn, typename ValueAt>
BlockHit find_first_largest(Index count, std::vector<double>& block_largest, double share,
                            int threads, Index fewest_parallel, const LargestIn& largest_in,
                            const ValueAt& value_at) {
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
  for (const double value : block_largest) largest = std::max(largest, value);
  if (largest <= 0.0) return {};
  // The two passes may be rounded differently.
  const double threshold = largest * share * (1.0 - 1e-14);
  for (Index b = 0; b < blocks; ++b) {
    if (block_largest[b] < threshold) continue;
    for (Index k = b * search_block_size; k < end_of(b); ++k) {
      const double value = value_at(k);
      if (value >= threshold) return {k, value};
    }
  }
  return {};
}

}  // namespace perilink
