#include "analysis/dynamics/lattice/rows/row_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace perilink {
namespace {

/// Times at which four stages did their rows.
struct Record {
  Index rows, reach;
  std::array<std::vector<int>, 4> time;
  std::vector<int> early;  ///< per row: works that came before what they need

  explicit Record(Index count, Index far) : rows(count), reach(far), early(count, 0) {
    for (auto& stage : time) stage.assign(rows, 0);
  }

  /// \param behind, ahead  rows at which the stage before must be done
  void work(int stage, Index row, Index behind, Index ahead) {
    if (stage > 0) {
      const Index last = std::min(rows - 1, row + ahead);
      for (Index near = std::max<Index>(0, row - behind); near <= last; ++near) {
        early[row] += time[stage - 1][near] == 0 ? 1 : 0;
      }
    }
    ++time[stage][row];
  }

  auto early_stages() {
    return std::tuple{RowStage{0, 0, [&](Index r) { work(0, r, 0, 0); }},
                      RowStage{reach, 0, [&](Index r) { work(1, r, reach, 0); }}};
  }
  auto missed_stages() {
    return std::tuple{RowStage{0, reach, [&](Index r) { work(2, r, 0, reach); }},
                      RowStage{reach, reach, [&](Index r) { work(3, r, reach, reach); }}};
  }
  void sweep(int threads) {
#pragma omp parallel num_threads(threads)
    sweep_rows(rows, std::tuple_cat(early_stages(), missed_stages()));
  }
};

TEST(RowSweep, DoesEveryRowOnceAndAfterWhatItNeeds) {
  for (const Index reach : {0, 1, 3}) {
    for (const Index rows : {1, 2, 5, 8, 9, 26, 27, 28, 40, 101}) {
      for (const int threads : {1, 2, 3, 4}) {
        Record record(rows, reach);
        record.sweep(threads);
        for (const auto& stage : record.time) {
          EXPECT_EQ(std::count(stage.begin(), stage.end(), 1), rows)
              << rows << " rows, reach " << reach << ", " << threads << " threads";
        }
        EXPECT_EQ(std::count(record.early.begin(), record.early.end(), 0), rows)
            << rows << " rows, reach " << reach << ", " << threads << " threads";
      }
    }
  }
}

// The point of the sweep: a row's last work comes as soon as it can, not after all first ones.
TEST(RowSweep, FollowsItselfAsCloselyAsItCan) {
  constexpr Index rows = 20, reach = 2;
  std::vector<Index> order;
#pragma omp parallel num_threads(1)
  sweep_rows(rows, std::tuple{RowStage{0, 0, [&](Index r) { order.push_back(r); }},
                              RowStage{0, reach, [&](Index r) { order.push_back(100 + r); }}});
  const auto done = [&](Index what) { return std::find(order.begin(), order.end(), what); };
  for (Index r = 0; r + reach + 1 < rows; ++r) {
    EXPECT_LT(done(100 + r), done(r + reach + 1));
  }
}

}  // namespace
}  // namespace perilink
