#include "analysis/dynamics/time_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace perilink {
namespace {

struct Nothing {};

/// Observer that counts its calls.
struct LoopWatcher {
  void on_row(const ExplicitRecord& record, const Nothing&) {
    if (record.step == throws_at) throw std::runtime_error("a full disk");
    rows.push_back(record.step);
  }
  void on_end(const ExplicitRecord&, const Nothing&) { ++ends; }
  bool stop_requested() { return stop_at >= 0 && now >= stop_at; }

  std::vector<Index> rows;
  std::vector<LoopState> saved;
  int ends = 0;
  Index now = 0, stop_at = -1;
  Index throws_at = -1;
};

/// Thousand steps of one with ten rows, energies from `energy`.
template <class Energy>
ExplicitResult run_rows(LoopWatcher& watcher, Energy energy, int rows = 10,
                        const LoopState* from = nullptr) {
  ExplicitOptions options;
  options.duration = 1000.0;
  options.ramp = 500.0;
  options.time_step = 1.0;
  options.rows = rows;
  ExplicitLoop loop(options, 2.0);
  if (from != nullptr) loop.restore(*from);
  ExplicitRecord record;
  const auto one_step = [&](Index step) {
    // Beyond numbers at the end, as in motions that grow.
    loop.note_reaction(step <= 300 ? step : step > 900 ? NAN : 0.0, 0.5 * step);
    if (!loop.is_looked_at(step)) return;
    watcher.now = step;
    record.energy = energy(step);
    loop.look(step, record, watcher, Nothing{}, [](ExplicitRecord&) {});
  };
  return loop.run(1, one_step, [&] { watcher.saved.push_back(loop.state()); });
}

EnergyBalance balanced(Index step) {
  EnergyBalance energy;
  energy.stored = energy.external_work = 1.0 * step;
  return energy;
}

/// Where the step cannot be the reason it is not named as one.
TEST(ExplicitLoop, TellsWhyAMotionMayHaveGrown) {
  LoopWatcher watcher;
  const ExplicitResult result = run_rows(watcher, [](Index step) {
    EnergyBalance energy;
    energy.kinetic = 1.0 * step;
    energy.external_work = 1.0;
    return energy;
  });
  EXPECT_EQ(result.termination, Termination::failed);
  EXPECT_NE(result.reason.find("the time step 1 is below the critical one of the intact body, 2"),
            std::string::npos)
      << result.reason;
}

TEST(ExplicitLoop, RowsAreEvenAndTheLastStepIsOne) {
  LoopWatcher watcher;
  const ExplicitResult result = run_rows(watcher, balanced);
  EXPECT_EQ(watcher.rows,
            (std::vector<Index>{0, 100, 200, 300, 400, 500, 600, 700, 800, 900, 1000}));
  EXPECT_EQ(watcher.ends, 1);
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_EQ(result.steps, 1000);
  EXPECT_EQ(result.last.load_factor, 1.0);
  EXPECT_EQ(result.peak_load, 300.0);
  EXPECT_EQ(result.peak_displacement, 150.0);
  EXPECT_EQ(result.largest_surplus, 0.0);
}

TEST(ExplicitLoop, LargestSurplusIsOverTheWork) {
  LoopWatcher watcher;
  const ExplicitResult result = run_rows(watcher, [](Index step) {
    EnergyBalance energy = balanced(step);
    energy.stored += step == 500 ? 4.0 : 1.0;  // two thousandths and less of the work at the end
    return energy;
  });
  EXPECT_DOUBLE_EQ(result.largest_surplus, 4.0 / 1001.0) << "one is there at the beginning";
}

TEST(ExplicitLoop, EnergyOutOfNothingEndsTheRun) {
  for (const double kinetic : {1e6, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    LoopWatcher watcher;
    const ExplicitResult result = run_rows(
        watcher,
        [&](Index step) {
          EnergyBalance energy = balanced(step);
          if (step >= 300) energy.kinetic = kinetic;
          return energy;
        },
        1);
    EXPECT_EQ(result.termination, Termination::failed);
    EXPECT_NE(result.reason.find("grew without external work at step 400"), std::string::npos)
        << "checked every 200 steps: " << result.reason;
    EXPECT_EQ(result.steps, 400);
    // A state that has overflowed is not a row.
    const bool finite = std::isfinite(kinetic);
    EXPECT_EQ(watcher.rows.back(), finite ? 400 : 0);
    EXPECT_EQ(watcher.ends, finite ? 1 : 0);
    EXPECT_TRUE(std::isfinite(result.last.energy.kinetic));
  }
}

TEST(ExplicitLoop, StopsBetweenRowsWhenAsked) {
  LoopWatcher watcher;
  watcher.stop_at = 150;
  const ExplicitResult result = run_rows(watcher, balanced, 1);
  EXPECT_EQ(result.termination, Termination::interrupted);
  EXPECT_EQ(watcher.rows, (std::vector<Index>{0, 200}));
  EXPECT_EQ(watcher.ends, 1);
}

TEST(ExplicitLoop, WhatObserversThrowEndsTheRunWithWhatWasFound) {
  LoopWatcher watcher;
  watcher.throws_at = 200;
  const ExplicitResult result = run_rows(watcher, balanced);
  EXPECT_EQ(result.termination, Termination::failed);
  EXPECT_EQ(result.reason, "a full disk");
  EXPECT_EQ(watcher.rows, (std::vector<Index>{0, 100}));
  EXPECT_EQ(result.steps, 200);
  EXPECT_EQ(result.peak_load, 200.0) << "of the steps so far";
}

TEST(ExplicitLoop, RefusesStepsThatAreNotStable) {
  ExplicitOptions options;
  EXPECT_THROW(ExplicitLoop(options, 1.0), std::invalid_argument) << "no duration";
  options.duration = 10.0;
  EXPECT_DOUBLE_EQ(ExplicitLoop(options, 1.0).time_step(), 0.9);
  options.time_step = 1.01;
  EXPECT_THROW(ExplicitLoop(options, 1.0), std::invalid_argument);
  options.refuse_unstable = false;
  EXPECT_EQ(ExplicitLoop(options, 1.0).time_step(), 1.01);
}

TEST(ExplicitLoop, GoesOnAfterEveryRowButTheLast) {
  LoopWatcher whole;
  const ExplicitResult result = run_rows(whole, balanced);
  ASSERT_EQ(whole.saved.size(), 10U);
  EXPECT_EQ(whole.saved[3].step, 302) << "after the round of the row of step 300";
  LoopWatcher later;
  const ExplicitResult resumed = run_rows(later, balanced, 10, &whole.saved[3]);
  EXPECT_EQ(later.rows, (std::vector<Index>{400, 500, 600, 700, 800, 900, 1000}));
  EXPECT_EQ(resumed.peak_load, result.peak_load);
  EXPECT_EQ(resumed.last, result.last);
  LoopState other = whole.saved[3];
  other.result.time_step = 0.5;
  EXPECT_THROW(run_rows(later, balanced, 10, &other), std::invalid_argument);
  other = whole.saved[3];
  other.step = 1002;
  EXPECT_THROW(run_rows(later, balanced, 10, &other), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
