#pragma once

#include <omp.h>

#include <algorithm>
#include <tuple>

#include "base/types.hpp"

namespace perilink {

/// A stage of a sweep over rows: what it does with a row, after the stages before it have done
/// theirs with that row, with `behind` rows before it and with `ahead` rows after it.
template <class Work>
struct RowStage {
  Index behind = 0;
  Index ahead = 0;
  Work work;
};
template <class Work>
RowStage(Index, Index, Work) -> RowStage<Work>;

/// How far apart the stages of a sweep work.
struct SweepReach {
  Index ahead = 0, behind = 0;  ///< sums over the stages: rows by which the last follows the first,
                                ///< and those that an edge leaves to it
  Index widest = 0;             ///< largest of either of any stage

  /// Least number of rows of a block.
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

/// Rows that some stages do among themselves: stage by stage each a range, which follows from the
/// one before.
namespace row_sweep {

/// Each stage follows the one before by as many rows as it needs, and leaves out those at edges of
/// the block that need rows of others. `first` and `last` say whether the block has no such edge.
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

/// What the blocks before and after an edge left out.
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

/// Runs every stage once on each row, in an order that finds in the cache what the stages before
/// wrote: each thread takes all stages together through a block of rows, row after row; the rows at
/// the edges of blocks come after a barrier. Too few rows for that are done stage by stage. To be
/// called by all threads of a parallel region; ends in a barrier.
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
