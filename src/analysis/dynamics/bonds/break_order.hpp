#pragma once

#include <compare>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Order in which bonds break, or particles crack, in a run that computes blocks of particles in
/// parallel. Steps in which nothing breaks take no time.
class BreakOrder {
 public:
  /// Number of a bond or particle and its step; ordered by step, then by number.
  struct Break {
    Index step, number;

    friend auto operator<=>(const Break&, const Break&) = default;
  };

  explicit BreakOrder(Index blocks) : of_blocks_(static_cast<std::size_t>(blocks)) {}

  /// Adds the numbers that broke in a block, in the step of its last call or a later one. A number
  /// that breaks again, such as the other half of a bond, counts once, also in a later step. Calls
  /// for different blocks may run in parallel.
  void add(Index block, Index step, std::span<const Index> broken) {
    for (const Index each : broken) of_blocks_[block].push_back({step, each});
  }

  /// Returns all numbers that broke so far, by step and then by number. Called by one thread
  /// between two steps.
  const std::vector<Index>& so_far();

  /// Returns the breaks added since the last call of so_far() or take_latest(), in their order,
  /// repeated ones included. Called by one thread between two steps.
  std::vector<Break> take_latest();

  /// Continues from so_far() of another run.
  void restore(const std::vector<Index>& order);

 private:
  void count(Index number);

  std::vector<std::vector<Break>> of_blocks_;
  std::vector<Index> order_;
  std::vector<bool> counted_;  ///< whether a number is in order_
};

}  // namespace perilink
