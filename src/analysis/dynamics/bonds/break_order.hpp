#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// The order in which bonds break, or particles crack, in a run whose blocks of particles are
/// worked on at once. Steps in which nothing breaks cost nothing.
class BreakOrder {
 public:
  explicit BreakOrder(Index blocks) : of_blocks_(static_cast<std::size_t>(blocks)) {}

  /// Adds what broke in a block, in the step of its last call or a later one. What breaks again,
  /// such as the other half of a bond, counts once, even in a later step. Calls for different
  /// blocks may run at once.
  void add(Index block, Index step, std::span<const Index> broken) {
    for (const Index each : broken) of_blocks_[block].emplace_back(step, each);
  }

  /// All that broke so far, first ones first, those of one step in the order of their numbers. To
  /// be called by one thread between two steps.
  const std::vector<Index>& so_far();

 private:
  std::vector<std::vector<std::pair<Index, Index>>> of_blocks_;  ///< (step, number), since so_far()
  std::vector<Index> order_;
  std::vector<bool> counted_;  ///< whether a number is in order_
};

}  // namespace perilink
