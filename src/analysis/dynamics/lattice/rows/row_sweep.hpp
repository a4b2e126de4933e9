#pragma once

#include <omp.h>

#include <algorithm>
#include <tuple>

#include "base/types.hpp"

namespace perilink {

/// Stage of a sweep over rows. `work` runs on a row after the preceding stages have finished that
/// row, `behind` rows before it and `ahead` rows after it.
template <class Work>
struct RowStage {
  Index behind = 0;
  Index ahead = 0;
  Work work;
};
template <class Work>
RowStage(Index, Index, Work) -> RowStage<Work>;

/// Distances between the stages of a sweep.
struct SweepReach {
  /// sums over the stages: `ahead`, rows by which the last stage follows the first; `behind`, rows
  /// that an edge leaves to the last stage
  Index ahead = 0, behind = 0;
  Index widest = 0;  ///< largest `ahead` or `behind` of a stage

  /// Returns the least number of rows of a block.
  Index shortest() const { return ahead + behind; }
};
template <class... Work>
SweepReach reach_of(const std::tuple<RowStage<Work>...>& all) {
  return std::apply(
      [](const auto&... stages) {
        return SweepReach{(0 + ... + stages.ahead), (0 + ... + stages.behind),
                          std::max({Index{0}, stages.ahead..., stages.behind...})};
      },
      all);
}

/// Runs stages over ranges of rows, where each range follows from the preceding stage.
namespace row_sweep {

/// Runs the stages over a block. Each stage follows the preceding one by the rows it needs, and
/// omits rows at edges of the block that need rows of other blocks. `first` and `last`: the block
/// is the first or the last one.
template <class... Work>
void sweep_block(Index begin, Index end, bool first, bool last, const RowStage<Work>&... stages) {
  const Index longest = (0 + ... + stages.ahead);
  for (Index front = begin; front < end + longest; ++front) {
    Index row = front, lower = begin, upper = end;
    const auto advance_stage = [&](const auto& stage) {
      row -= stage.ahead;
      if (!first) lower += stage.behind;
      if (!last) upper -= stage.ahead;
      if (row >= lower && row < upper) stage.work(row);
    };
    (advance_stage(stages), ...);
  }
}

/// Runs the stages on rows that the blocks before and after an edge omitted.
template <class... Work>
void sweep_edge(Index edge, const RowStage<Work>&... stages) {
  Index lower = edge, upper = edge;
  const auto run_stage = [&](const auto& stage) {
    lower -= stage.ahead;
    upper += stage.behind;
    for (Index row = lower; row < upper; ++row) stage.work(row);
  };
  (run_stage(stages), ...);
}

template <class Work>
void run_stage(Index rows, const RowStage<Work>& stage) {
#pragma omp for schedule(static)
  for (Index row = 0; row < rows; ++row) stage.work(row);
}

}  // namespace row_sweep

/// Runs every stage once on each row, ordered so that values of earlier stages are still in the
/// cache. Each thread runs all stages through a block of rows, row after row. Rows at edges of
/// blocks follow after a barrier. With too few rows the stages run one after the other. Called by
/// all threads of a parallel region; ends in a barrier.
template <class... Work>
void sweep_rows(Index count, const std::tuple<RowStage<Work>...>& all) {
  const Index shortest = reach_of(all).shortest();
  const auto sweep = [count, shortest](const RowStage<Work>&... stages) {
    const Index blocks = omp_get_num_threads();
    if (blocks > 1 && count / blocks < shortest) {
      (row_sweep::run_stage(count, stages), ...);
      return;
    }
    const auto begin = [&](Index block) { return count * block / blocks; };
#pragma omp for schedule(static)
    for (Index b = 0; b < blocks; ++b) {
      row_sweep::sweep_block(begin(b), begin(b + 1), b == 0, b == blocks - 1, stages...);
    }
    if (blocks == 1) return;
#pragma omp for schedule(static)
    for (Index b = 1; b < blocks; ++b) row_sweep::sweep_edge(begin(b), stages...);
  };
  std::apply(sweep, all);
}

}  // namespace perilink
