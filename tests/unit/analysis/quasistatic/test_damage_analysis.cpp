#include "analysis/quasistatic/damage_analysis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.hpp"
#include "io/case/case_words.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;
using testing::HasSubstr;

DamageOptions by_steps(std::vector<double> load_factors) {
  DamageOptions options;
  options.load_factors = std::move(load_factors);
  return options;
}

/// Chains of two bonds between fixed and displaced particles: row r breaks at displacement 2 s_r,
/// independent of the others. The limits are in no order.
AnalysisBody make_driven_chains() {
  AnalysisBody body = make_chains(2, 5, true, 1.0, infinity);
  const double limits[] = {0.03, 0.01, 0.05, 0.02, 0.04};
  for (int row = 0; row < 5; ++row) {
    body.network.critical_stretch[bonds_of_row(body.network, row)[row % 2]] = limits[row];
  }
  return body;
}

/// make_square(): row by row what test_make_event_engine.cpp works out.
TEST(DamageAnalysis, CollapsesExactlyWhenTheLastLoadPathGoes) {
  const AnalysisBody body = make_square();
  Recorder recorder;
  const DamageResult result = run(body, {}, recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  EXPECT_THAT(result.reason, HasSubstr("separated"));
  EXPECT_EQ(result.broken_bonds, 2);
  EXPECT_NEAR(result.initial_stiffness, 2.0 * 2.0 / (4.0 / 3.0), 1e-14);
  EXPECT_NEAR(result.peak_load, 0.03, 1e-16);
  EXPECT_NEAR(result.peak_displacement, 0.01, 1e-16);
  EXPECT_LT(result.largest_residual, 1e-14);
  EXPECT_LT(result.energy_error, 1e-14);

  ASSERT_EQ(recorder.rows.size(), 2u);
  const StepRecord& first = recorder.rows[0];
  EXPECT_EQ(first.step, 1);
  EXPECT_EQ(first.broken_bonds, 0);
  EXPECT_NEAR(first.load_factor, 0.015, 1e-16);
  EXPECT_NEAR(first.load, 0.03, 1e-16);
  EXPECT_NEAR(first.displacement, 0.015 * 2.0 / 3.0, 1e-16);  // over both loaded particles
  EXPECT_NEAR(first.external_work, 0.5 * 0.03 * 0.01, 1e-18);
  EXPECT_EQ(first.dissipated_energy, 0.0);
  const StepRecord& second = recorder.rows[1];
  EXPECT_EQ(second.step, 2);
  EXPECT_EQ(second.broken_bonds, 1);
  EXPECT_NEAR(second.load, 0.02, 1e-16);
  EXPECT_NEAR(second.displacement, 0.01 * (8.0 / 3.0) / 2.0, 1e-16);  // mean of 2 and 2/3
  EXPECT_NEAR(second.dissipated_energy, 0.5 * 0.015 * 0.01 * 4.0 / 3.0, 1e-18);
  EXPECT_NEAR(second.released_energy, 0.015 * 0.015 * 0.5 * 4.0 / 9.0, 1e-18);
  EXPECT_EQ(recorder.ends, 1);
  EXPECT_EQ(recorder.row_at_end.step, 2);
  EXPECT_EQ(recorder.broken_at_end, 1) << "the body before it separated";
}

/// Four chains break at a displacement of 0.01 under half of that each; the fifth carries 0.2.
TEST(DamageAnalysis, TellsTheFirstPeakFromWhatIsBorneAfterwards) {
  AnalysisBody body = make_chains(2, 5, true, 1.0, infinity);
  for (int row = 0; row < 5; ++row) {
    const double limit = row < 4 ? 0.005 : 0.1;
    body.network.critical_stretch[bonds_of_row(body.network, row)[0]] = limit;
  }
  Recorder recorder;
  const DamageResult result = run(body, {}, recorder);
  EXPECT_TRUE(result.peaks.climbed_again());
  EXPECT_NEAR(result.peaks.first().load, 5 * 0.5 * 0.01, 1e-15);
  EXPECT_NEAR(result.peaks.first().displacement, 0.01, 1e-15);
  EXPECT_NEAR(result.peaks.highest().load, 0.5 * 0.2, 1e-15);
  EXPECT_EQ(result.peak_load, result.peaks.first().load);
  EXPECT_EQ(result.broken_as_gave_way, 4);
  EXPECT_FALSE(result.smoothed_peak_load) << "five events are no curve";
}

/// A limit that is not a number is no bond that never breaks.
TEST(DamageAnalysis, FailsWhereAMeasureIsNotANumber) {
  AnalysisBody body = make_square();
  body.network.critical_stretch[1] = NAN;
  Recorder recorder;
  const DamageResult result = run(body, {}, recorder);
  EXPECT_EQ(result.termination, Termination::failed);
  EXPECT_THAT(result.reason, HasSubstr("element 1 "));
  EXPECT_THAT(result.reason, HasSubstr("not a finite number"));
}

TEST(DamageAnalysis, EndsWhenNothingBreaks) {
  AnalysisBody body = make_square();
  for (double& force : body.loads.forces) force = -force;
  Recorder recorder;
  const DamageResult result = run(body, {}, recorder);
  EXPECT_EQ(result.termination, Termination::nothing_breaks);
  EXPECT_EQ(result.broken_bonds, 0);
  EXPECT_TRUE(recorder.rows.empty());
  EXPECT_EQ(recorder.ends, 1);
}

TEST(DamageAnalysis, RefusesLoadsThatDoNoWork) {
  AnalysisBody body = make_square();
  for (double& force : body.loads.forces) force = 0.0;
  Recorder recorder;
  EXPECT_THROW(run(body, {}, recorder), SolverError);
}

TEST(DamageAnalysis, StopsAtANumberOfBrokenBonds) {
  DamageOptions options;
  options.stop.broken_bonds = 3;
  Recorder recorder;
  const DamageResult result = run(make_driven_chains(), options, recorder);
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_THAT(result.reason, HasSubstr("3 bonds"));
  EXPECT_EQ(result.broken_bonds, 3);
  EXPECT_EQ(recorder.rows.back().broken_bonds, 3);
  EXPECT_EQ(recorder.rows.size(), 4u);
}

/// The load factor of make_square() falls from 0.015 to 0.01.
TEST(DamageAnalysis, StopsAtAFractionOfThePeak) {
  for (const auto& [fraction, termination] :
       {std::pair{0.66, Termination::collapsed}, std::pair{0.67, Termination::completed}}) {
    DamageOptions options;
    options.stop.load_fraction = fraction;
    options.stop.load_fraction_rows = 1;
    Recorder recorder;
    const DamageResult result = run(make_square(), options, recorder);
    EXPECT_EQ(result.termination, termination) << fraction;
    EXPECT_EQ(recorder.rows.size(), 2u);
  }
}

TEST(DamageAnalysis, StopsAtADisplacement) {
  DamageOptions options;
  options.stop.displacement = 0.059;  // rows at 0.02, 0.04, 0.06
  Recorder recorder;
  const DamageResult result = run(make_driven_chains(), options, recorder);
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_THAT(result.reason, HasSubstr("displacement"));
  EXPECT_EQ(recorder.rows.size(), 3u);
}

TEST(DamageAnalysis, StopsWhenTheObserverAsks) {
  Recorder recorder({}, 2);
  const DamageResult result = run(make_driven_chains(), {}, recorder);
  EXPECT_EQ(result.termination, Termination::interrupted);
  EXPECT_EQ(recorder.rows.size(), 2u);
  EXPECT_EQ(recorder.broken_at_end, recorder.row_at_end.broken_bonds);
}

/// Asked before the second event of a step, the run ends with a row at the load that the body as it
/// stands carries.
TEST(DamageAnalysis, AnObserverThatFailsLeavesWhatWasFound) {
  class FullDisk final : public StepObserver {
   public:
    void on_step(const StepRecord& record, StateSource&) override {
      if (record.step == 2) throw FileError("no room");
    }
  } observer;
  const AnalysisBody body = make_driven_chains();
  const DamageResult result = run_damage_analysis(body, {}, observer);
  EXPECT_EQ(result.termination, Termination::failed);
  EXPECT_EQ(result.reason, "no room");
  EXPECT_EQ(result.last.step, 2);
  EXPECT_GT(result.peak_load, 0.0);
}

TEST(DamageAnalysis, StopsWithinAStep) {
  class Impatient final : public StepObserver {
   public:
    void on_step(const StepRecord& record, StateSource&) override { rows.push_back(record); }
    bool stop_requested() override { return ++questions == 2; }
    std::vector<StepRecord> rows;
    int questions = 0;
  } observer;
  const AnalysisBody body = make_driven_chains();
  const DamageResult result = run_damage_analysis(body, by_steps({0.09}), observer);
  EXPECT_EQ(result.termination, Termination::interrupted);
  ASSERT_EQ(observer.rows.size(), 1u);
  EXPECT_EQ(observer.rows[0].broken_bonds, 1);
  EXPECT_NEAR(observer.rows[0].load_factor, 0.04, 1e-15);
  EXPECT_LT(result.energy_error, 1e-14);
}

/// Driven chains: events at displacements 0.02, 0.04 ... 0.1 and then no resistance is left.
TEST(DamageAnalysis, DrivenBodyEndsWhenItsResistanceVanishes) {
  Recorder recorder;
  const AnalysisBody body = make_driven_chains();
  const DamageResult result = run(body, {}, recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  EXPECT_THAT(result.reason, HasSubstr("no longer resists"));
  EXPECT_EQ(result.broken_bonds, 5);
  EXPECT_NEAR(result.initial_stiffness, 5 * 0.5, 1e-14);
  ASSERT_EQ(recorder.rows.size(), 6u);
  double dissipated = 0.0;
  for (int k = 0; k < 5; ++k) {
    const StepRecord& row = recorder.rows[k];
    EXPECT_EQ(row.step, k + 1);
    EXPECT_EQ(row.broken_bonds, k);
    EXPECT_NEAR(row.load_factor, 0.02 * (k + 1), 1e-15);
    EXPECT_NEAR(row.displacement, 0.02 * (k + 1), 1e-15);
    EXPECT_NEAR(row.load, 0.5 * (5 - k) * row.displacement, 1e-15);
    EXPECT_NEAR(row.dissipated_energy, dissipated, 1e-15);
    dissipated += 0.25 * row.load_factor * (k < 4 ? 0.02 * (k + 2) : row.load_factor);
  }
  const StepRecord& last = recorder.rows[5];
  EXPECT_EQ(last.broken_bonds, 5);
  EXPECT_EQ(last.element, no_index);
  EXPECT_NEAR(last.load, 0.0, 1e-15);
  EXPECT_NEAR(last.displacement, 0.1, 1e-15);
  EXPECT_NEAR(last.dissipated_energy, dissipated, 1e-15) << "with the bond that went last";
  EXPECT_NEAR(last.external_work, dissipated, 1e-15);
  EXPECT_EQ(recorder.broken_at_end, 5);
}

/// While the load factor rises from event to event, prescribed steps find the same cracks: after
/// the step to L those bonds are broken that events break at or below L.
TEST(DamageAnalysis, StepsBreakWhatEventsBreak) {
  const AnalysisBody body = make_driven_chains();
  Recorder events;
  run(body, {}, events);
  std::vector<Index> broken;
  Recorder steps([&](const StepRecord& row, StateSource& source) {
    const StepState state = source.state();
    for (const StepRecord& event : events.rows) {
      if (event.element == no_index) continue;
      EXPECT_EQ(state.secants[event.element] == 0.0, event.load_factor <= row.load_factor);
    }
    broken.push_back(Recorder::broken_bonds(state));
  });
  const DamageResult result = run(body, by_steps({0.01, 0.03, 0.03, 0.05, 0.09}), steps);
  EXPECT_EQ(result.termination, Termination::completed);
  EXPECT_EQ(broken, (std::vector<Index>{0, 1, 1, 2, 4}));
  EXPECT_LT(result.energy_error, 1e-14);
  // Unloading breaks no bond.
  Recorder back;
  EXPECT_EQ(run(body, by_steps({0.05, 0.01}), back).broken_bonds, 2);
  EXPECT_EQ(back.rows[1].broken_bonds, 2);
}

/// Under a constant force of 0.016 the square loses a horizontal bond and cannot carry that force
/// any more. The last row describes the body before separation, at the 0.01 that it can carry.
TEST(DamageAnalysis, StepsCollapseWithinAStep) {
  Recorder recorder;
  const DamageResult result = run(make_square(), by_steps({0.012, 0.016, 0.02}), recorder);
  EXPECT_EQ(result.termination, Termination::collapsed);
  EXPECT_EQ(result.broken_bonds, 2);
  ASSERT_EQ(recorder.rows.size(), 2u);
  EXPECT_EQ(recorder.rows[1].broken_bonds, 1);
  EXPECT_EQ(recorder.broken_at_end, 1);
  EXPECT_NEAR(recorder.rows[1].load_factor, 0.01, 1e-16);
  EXPECT_LT(result.energy_error, 1e-13);
  EXPECT_THAT(result.reason, HasSubstr("cannot carry the load factor 0.016"));
  // Its energies are those of a load that follows the body.
  Recorder events;
  run(make_square(), {}, events);
  const StepRecord &fallen = recorder.rows[1], &followed = events.rows[1];
  EXPECT_NEAR(fallen.load_factor, followed.load_factor, 1e-16);
  EXPECT_NEAR(fallen.dissipated_energy, followed.dissipated_energy, 1e-15);
  EXPECT_NEAR(fallen.external_work, followed.external_work, 1e-15);
  EXPECT_NEAR(fallen.released_energy, followed.released_energy, 1e-15);
}

/// A saw-tooth that stands for a plateau (see test_single_event_engine.cpp): after n segments the
/// bar has lost exactly what the plateau dissipates up to the strain s_y r^n, k_b s_y^2 (r^n - 1) /
/// 2. The path drawn through the peaks of the segments lies above by the overshoot: here, with one
/// unknown, lambda_k grows with the pivot so that each event dissipates r times the energy
/// released.
TEST(DamageAnalysis, YieldingBarDissipatesThePlateau) {
  constexpr double strain = 0.01, r = 1.05, stiffness = 2.0;
  const BarMaterial bar{stiffness, 1.0, stiffness * strain, false};
  const AnalysisBody body =
      make_chains(2, 2, true, 1.0, infinity, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}, bar);
  DamageOptions options;
  options.stop.displacement = 0.4;
  Recorder recorder;
  run(body, options, recorder);
  ASSERT_GT(recorder.rows.size(), 50u);
  for (const StepRecord& row : recorder.rows) {
    const double plateau =
        0.5 * stiffness * strain * strain * (std::pow(r, row.yield_events) - 1.0);
    EXPECT_EQ(row.yield_events, row.step - 1);
    EXPECT_NEAR(row.released_energy, plateau, 1e-13 * stiffness * strain);
    EXPECT_NEAR(row.dissipated_energy, r * plateau, 1e-13 * stiffness * strain);
  }
}

class DamagedBlock : public testing::TestWithParam<BlockCase> {
 protected:
  /// A bar across a crack yields for ever.
  static constexpr int most_rows = 200;
};

TEST_P(DamagedBlock, EndsInTwoUnlessSomethingUnbreakableHoldsIt) {
  Recorder recorder({}, most_rows);
  const DamageResult result = run(make_block(GetParam()), {}, recorder);
  // In the small cube the unbreakable bonds of the two faces meet.
  EXPECT_EQ(result.termination, GetParam().bar ? Termination::interrupted
                                : GetParam().lattice.pattern == Pattern::cubic
                                    ? Termination::nothing_breaks
                                    : Termination::collapsed)
      << result.reason;
}

TEST_P(DamagedBlock, AllRoutesFindTheSameEvents) {
  const AnalysisBody body = make_block(GetParam());
  Recorder reference({}, most_rows);
  const DamageResult expected = run(body, {}, reference);
  EXPECT_GT(reference.rows.size(), 5u);
  for (const FactorRoute route : {FactorRoute::cholmod_updown, FactorRoute::refactorize}) {
    DamageOptions options;
    options.engine.route = route;
    Recorder recorder({}, most_rows);
    const DamageResult result = run(body, options, recorder);
    EXPECT_EQ(result.termination, expected.termination) << result.reason;
    ASSERT_EQ(recorder.rows.size(), reference.rows.size()) << word_of(route);
    for (std::size_t k = 0; k < recorder.rows.size(); ++k) {
      ASSERT_EQ(recorder.rows[k].element, reference.rows[k].element) << "row " << k;
      EXPECT_NEAR(recorder.rows[k].load_factor, reference.rows[k].load_factor,
                  1e-9 * reference.rows[k].load_factor);
    }
  }
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// All values of a row except the time.
TEST_P(DamagedBlock, ThreadsDoNotChangeARow) {
  const AnalysisBody body = make_block(GetParam());
  Recorder one({}, most_rows), two({}, most_rows);
  DamageOptions options;
  run(body, options, one);
  options.engine.threads = 2;
  run(body, options, two);
  const std::vector<StepRecord>&a = one.rows, &b = two.rows;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(a[k].step == b[k].step && a[k].broken_bonds == b[k].broken_bonds &&
                a[k].yield_events == b[k].yield_events && a[k].element == b[k].element &&
                a[k].factorizations == b[k].factorizations)
        << k;
    for (const auto field :
         {&StepRecord::load_factor, &StepRecord::load, &StepRecord::displacement,
          &StepRecord::strain_energy, &StepRecord::dissipated_energy, &StepRecord::external_work,
          &StepRecord::released_energy, &StepRecord::residual}) {
      EXPECT_TRUE(same_bits(a[k].*field, b[k].*field)) << k;
    }
  }
}

/// Without scatter the block is symmetric and elements fail at exactly equal ratios.
INSTANTIATE_TEST_SUITE_P(DamageAnalysis, DamagedBlock,
                         testing::Values(BlockCase{rectangular}, BlockCase{hexagonal, true, true},
                                         BlockCase{hexagonal_ghost, false, true},
                                         BlockCase{rectangular, true, false, 6, 0.0},
                                         BlockCase{cubic, false, false, 3, 0.0},
                                         BlockCase{cubic, true, false, 3},
                                         BlockCase{hexagonal, false, true, 6, 0.1, true},
                                         BlockCase{cubic, true, false, 3, 0.1, true}),
                         [](const auto& test) {
                           return to_string(test.param) + "_" + std::to_string(test.index);
                         });

}  // namespace
}  // namespace perilink
