#pragma once

#include <compare>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// The order in which bonds break, or particles crack, in a run whose blocks of particles are
/// worked on at once. Steps in which nothing breaks cost nothing.
class BreakOrder {
 public:
  /// Whatever is numbered, and when it broke; in the order that counts.
  struct Break {
    Index step, number;

    friend auto operator<=>(const Break&, const Break&) = default;
  };

  explicit BreakOrder(Index blocks) : of_blocks_(static_cast<std::size_t>(blocks)) {}

  /// Adds what broke in a block, in the step of its last call or a later one. What breaks again,
  /// such as the other half of a bond, counts once, even in a later step. Calls for different
  /// blocks may run at once.
  void add(Index block, Index step, std::span<const Index> broken) {
    for (const Index each : broken) of_blocks_[block].push_back({step, each});
  }

  /// All that broke so far, first ones first, those of one step in the order of their numbers. To
  /// be called by one thread between two steps.
  const std::vector<Index>& so_far();

  /// All that was added since so_far() or this was called last, in their order, what broke again
  /// included. Called as so_far() is.
  std::vector<Break> take_latest();

 private:
  std::vector<std::vector<Break>> of_blocks_;
  std::vector<Index> order_;
  std::vector<bool> counted_;  ///< whether a number is in order_
};

}  // namespace perilink
