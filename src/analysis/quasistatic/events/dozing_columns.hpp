#pragma once

#include <array>
#include <functional>
#include <vector>

#include "analysis/quasistatic/subdomains/deferred_motion.hpp"
#include "base/block.hpp"
#include "base/types.hpp"

namespace perilink {

/// Blocks of a search that need no look at every event while displacements are combined from
/// columns. The ratio R of a bond to its limit is a seminorm of the motion, so that with steps s
/// along the columns y since the last look
///
///   R(u) <= R(u_0) + sum over columns |s| R(y).
///
/// While that is below what another bond has come to, the block sleeps, and its particles keep the
/// displacements of then. What is found is what a search among all finds.
class DozingColumns {
 public:
  /// Largest ratio that each of a block of columns gives a bond of a search block.
  /// \param columns  shape (particles, width, block_width)
  using LargestOfColumns =
      std::function<std::array<double, block_width>(Index block, const double* columns)>;
  /// Slots of the ends of the bonds of a search block: the first component of each.
  using EndsOf = std::function<void(Index block, const std::function<void(std::size_t)>& visit)>;

  /// Nothing dozes.
  DozingColumns() = default;
  /// \param motion  kept by reference
  DozingColumns(const DeferredMotion& motion, Index blocks, int dim, LargestOfColumns largest_of,
                EndsOf ends_of);

  bool any() const { return motion_ != nullptr; }
  bool may_doze(Index /*block*/) const { return any(); }
  /// Takes in what the columns have moved since; before a search.
  void follow();
  /// The block with the largest bound, which is looked at first.
  Index likeliest() const;
  /// Largest ratio that a bond of the block can have now.
  double bound(Index block) const { return bounds_[static_cast<std::size_t>(block)]; }
  /// Makes the displacements of the block's particles current, for a look.
  void look(Index block);
  /// The largest ratio that this look has found.
  void remember(Index block, double largest);
  /// The limit of a bond of the block has changed: it is looked at next time and, where the limit
  /// is lower than before, always.
  void wake(Index block, bool is_lower);

 private:
  void measure_columns();

  const DeferredMotion* motion_ = nullptr;
  int dim_ = 0;
  LargestOfColumns largest_of_;
  EndsOf ends_of_;
  std::vector<double> bounds_;
  std::vector<bool> restless_;
  std::vector<std::vector<double>> ratios_;  ///< R(y), of each block of columns: shape
                                             ///< (block_width, search blocks)
  std::vector<double> counted_;              ///< DeferredMotion::moved, as far as bounds know it
  int restarts_ = 0, renewals_ = 0;
  std::vector<int> seen_;  ///< per particle: DeferredMotion::changes that its displacement knows
};

}  // namespace perilink
