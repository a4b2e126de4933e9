#include "analysis/dynamics/lattice/ranks/lattice_share.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_loads.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "app/process/serve.hpp"
#include "support/lattice_models.hpp"
#include "support/thread_ranks.hpp"

namespace perilink {
namespace {

using namespace testing_support;
using test::with_thread_ranks;

/// Keeps the rows and what field files have of the last one; asks to stop after some rows.
class Watcher final : public ExplicitObserver {
 public:
  explicit Watcher(std::size_t rows) : wanted_(rows) {}
  void on_row(const ExplicitRecord& record, const ExplicitState& /*state*/) override {
    rows.push_back(record);
  }
  void on_end(const ExplicitRecord& /*last*/, const ExplicitState& state) override {
    fields = {state.displacement, state.velocity,    state.damage,    state.now.effective,
              state.now.sum,      state.now.stretch, state.flow.half, state.flow.equivalent,
              state.flow.normal,  state.flow.stretch};
    cracked_in = state.cracked_in;
    ++ends;
  }
  bool stop_requested() override { return rows.size() >= wanted_; }

  std::vector<ExplicitRecord> rows;
  std::vector<std::vector<double>> fields;
  std::vector<Index> cracked_in;
  int ends = 0;

 private:
  std::size_t wanted_;
};

struct Outcome {
  Watcher watcher;
  ExplicitResult result;
};

Outcome run(const ExplicitModel& model, const ExplicitOptions& options, std::size_t stop_after) {
  ExplicitState state(model);
  shake_velocities(model, state);
  Outcome outcome{Watcher(stop_after), {}};
  outcome.result = run_explicit_analysis(model, state, options, outcome.watcher);
  return outcome;
}

void expect_the_same(const Outcome& found, const Outcome& alone, const ExplicitModel& model) {
  EXPECT_EQ(found.watcher.ends, 1);
  EXPECT_EQ(found.result.termination, alone.result.termination) << found.result.reason;
  EXPECT_EQ(found.result.peak_load, alone.result.peak_load);
  EXPECT_EQ(found.result.peak_displacement, alone.result.peak_displacement);
  ASSERT_EQ(found.watcher.rows.size(), alone.watcher.rows.size());
  for (std::size_t r = 0; r < alone.watcher.rows.size(); ++r) {
    const ExplicitRecord &own = found.watcher.rows[r], &row = alone.watcher.rows[r];
    EXPECT_EQ(own.step, row.step);
    EXPECT_EQ(own.load, row.load);
    EXPECT_EQ(own.displacement, row.displacement);
    EXPECT_EQ(own.support_reaction, row.support_reaction);
    EXPECT_EQ(own.cracked_particles, row.cracked_particles);
    EXPECT_EQ(own.yielded_particles, row.yielded_particles);
    EXPECT_EQ(own.energy.kinetic, row.energy.kinetic);
    EXPECT_EQ(own.energy.stored, row.energy.stored);
    EXPECT_EQ(own.energy.internal_damping, row.energy.internal_damping);
    EXPECT_EQ(own.energy.external_damping, row.energy.external_damping);
    EXPECT_EQ(own.energy.fractured, row.energy.fractured);
    EXPECT_EQ(own.energy.plastic, row.energy.plastic);
    EXPECT_EQ(own.energy.external_work, row.energy.external_work);
  }
  // Stresses are written of bodies that cannot break, plastic stretches by the papers' rules.
  for (std::size_t k = 0; k < alone.watcher.fields.size(); ++k) {
    const bool of_stress = k >= 3 && k != 7 && k != 9;
    if (of_stress && model.material.breakable) continue;
    if (k == 9 && model.rules == LatticeRules::consistent) continue;
    EXPECT_EQ(found.watcher.fields[k], alone.watcher.fields[k]) << "field " << k;
  }
  EXPECT_EQ(found.watcher.cracked_in, alone.watcher.cracked_in);
}

class SharedLatticeRuns : public testing::TestWithParam<LatticeKind> {};

TEST_P(SharedLatticeRuns, RanksChangeNothing) {
  const LatticeKind kind = GetParam();
  ExplicitModel model = changing_body(kind);
  const std::vector<Index>& slots = model.lattice.particle_slot;
  apply_forces(model, {{slots[slots.size() / 4], 0, 2.0}, {slots[3 * slots.size() / 4], 0, 1.0}});
  ExplicitOptions options = short_run(model, 40);
  options.rows = 8;
  const bool in_space = kind.problem == Problem::three_dimensional;
  for (const std::size_t stop_after : {100, 3}) {
    const Outcome alone = run(model, options, stop_after);
    const ExplicitRecord& last = alone.watcher.rows.back();
    if (stop_after == 100) {
      EXPECT_EQ(last.cracked_particles > 0, kind.breakable);
      EXPECT_EQ(last.yielded_particles > 0, kind.yields);
    }
    for (const int count : {2, 3}) {
      with_thread_ranks(
          count,
          [&](Ranks& ranks) {
            ExplicitOptions shared = options;
            shared.ranks = &ranks;
            const Outcome found = run(model, shared, stop_after);
            dismiss(ranks);
            EXPECT_EQ(found.result.ranks, in_space && model.alters() ? 2 : count) << "of many rows";
            expect_the_same(found, alone, model);
          },
          serve);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SharedLatticeRuns,
    testing::Values(LatticeKind{Problem::plane_stress, LatticeRules::consistent, false, false},
                    LatticeKind{Problem::plane_stress, LatticeRules::consistent, true, false},
                    LatticeKind{Problem::plane_strain, LatticeRules::consistent, true, true},
                    LatticeKind{Problem::plane_strain, LatticeRules::consistent, false, true},
                    LatticeKind{Problem::plane_stress, LatticeRules::least_2018, true, true},
                    LatticeKind{Problem::plane_stress, LatticeRules::mean_2017, true, true},
                    LatticeKind{Problem::three_dimensional, LatticeRules::consistent, false, false},
                    LatticeKind{Problem::three_dimensional, LatticeRules::consistent, true, true}));

}  // namespace
}  // namespace perilink
