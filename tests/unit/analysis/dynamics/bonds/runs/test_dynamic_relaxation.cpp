#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

class StepRecorder final : public BondRunObserver {
 public:
  void on_row(const ExplicitRecord& record, const BondRunState& state) override {
    if (rows.size() == most_rows) throw std::runtime_error("the disk is full");
    rows.push_back(record);
    displacement = state.motion.displacement;
  }
  void on_end(const ExplicitRecord&, const BondRunState&) override { ++ends; }
  void on_iteration(Index, Index, double) override {
    if (breaks) throw std::runtime_error("the disk is full");
  }
  bool stop_requested() override { return stops; }

  bool stops = false, breaks = false;
  std::size_t most_rows = 1000;
  int ends = 0;
  std::vector<ExplicitRecord> rows;
  std::vector<double> displacement;  ///< in the last row
};

struct Relaxed {
  RelaxationResult result;
  StepRecorder recorder;
};

Relaxed relax(const AnalysisBody& body, const RelaxationOptions& options) {
  Relaxed outcome;
  outcome.result = run_dynamic_relaxation(body, options, outcome.recorder);
  return outcome;
}

AnalysisBody unbreakable(AnalysisBody body) {
  std::fill(body.network.critical_stretch.begin(), body.network.critical_stretch.end(), INFINITY);
  return body;
}

class RelaxedBlocks : public testing::TestWithParam<BlockCase> {};

TEST_P(RelaxedBlocks, RestInStaticEquilibrium) {
  const AnalysisBody body = unbreakable(make_block(GetParam()));
  RelaxationOptions options;
  options.tolerance = 1e-8;
  const Relaxed outcome = relax(body, options);
  ASSERT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
  EXPECT_LE(outcome.result.residual, options.tolerance);
  EXPECT_LE(outcome.result.error, options.tolerance);
  const Eigen::VectorXd statics = dense_displacement(body, intact(body.network));
  // The largest component against a mean of all.
  EXPECT_LT(difference(outcome.recorder.displacement, statics), 4.0 * options.tolerance);
  // Critical damping: of the order of the periods of the body in steps, some dozens.
  EXPECT_LT(outcome.result.iterations, 2000);
  ASSERT_EQ(outcome.recorder.rows.size(), 1U);
  EXPECT_EQ(outcome.recorder.ends, 1);
  const ExplicitRecord& row = outcome.recorder.rows[0];
  EXPECT_NEAR(row.energy.stored, 0.5 * row.load * row.displacement, 2e-8 * row.energy.stored);
  EXPECT_NEAR(row.energy.external_damping, 0.0, 2e-8 * row.energy.stored);
}

TEST(Relaxation, ThreadsChangeNothing) {
  const AnalysisBody body =
      make_block({{"plane", Pattern::rectangular, Surface::none}, true, false, 100});
  const Network& network = body.network;
  ASSERT_EQ(ParticleBlocks(network.particles.size(), network.width()).threads(2), 2);
  RelaxationOptions options;
  options.most_iterations = 100;
  const Relaxed one = relax(body, options);
  options.threads = 2;
  const Relaxed two = relax(body, options);
  EXPECT_EQ(two.result.residual, one.result.residual);
  EXPECT_EQ(two.result.error, one.result.error);
  EXPECT_EQ(two.result.displacement, one.result.displacement);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, RelaxedBlocks,
    testing::Values(BlockCase{{"plane", Pattern::rectangular, Surface::none}, true},
                    BlockCase{{"plane", Pattern::rectangular, Surface::none}, false, true},
                    BlockCase{{"hexagonal", Pattern::hexagonal, Surface::calibrated}},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 4},
                    BlockCase{
                        {"plane", Pattern::rectangular, Surface::none}, true, false, 6, 0.1, true},
                    BlockCase{{"space", Pattern::cubic, Surface::none}, true, false, 4, 0.1, true}),
    [](const auto& body) { return to_string(body.param) + std::to_string(body.index); });

/// A load step starts from the scaled last equilibrium. If that is an equilibrium, it needs no
/// further iteration.
TEST(DynamicRelaxation, LoadStepsStartWhereTheyEnd) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  RelaxationOptions options;
  options.load_factors = {0.25, 0.5, 1.0};
  const Relaxed outcome = relax(body, options);
  ASSERT_EQ(outcome.recorder.rows.size(), 3U);
  EXPECT_EQ(outcome.recorder.rows[2].step, outcome.recorder.rows[0].step + 2);
  // Two rows of six springs of 10, moved by 1.
  EXPECT_NEAR(outcome.recorder.rows[2].load, 2.0 * 10.0 / 6.0, 1e-5);
  EXPECT_NEAR(outcome.result.peak_load, -2.0 * 10.0 / 6.0, 1e-5);
  EXPECT_EQ(outcome.recorder.rows[2].time, 3.0);
}

/// With the stretch s = 1/2 a bond of length 1 has g = s + s^2/2 and pulls k g (1 + s).
TEST(DynamicRelaxation, GreenStrainsOfAChain) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  RelaxationOptions options;
  options.load_factors = {1.0, 2.0, 3.0};
  options.strain = Strain::green;
  options.safety = 0.5;  // the stretch stiffens bonds 2.9 times
  options.tolerance = 1e-9;
  const Relaxed outcome = relax(body, options);
  ASSERT_EQ(outcome.result.termination, Termination::completed) << outcome.result.reason;
  EXPECT_NEAR(outcome.result.last.load, 2.0 * 10.0 * 0.625 * 1.5, 1e-7);
  EXPECT_NEAR(outcome.result.last.energy.stored, 2.0 * 6.0 * 0.5 * 10.0 * 0.625 * 0.625, 1e-7);
}

/// Springs in series hold up to their limit and break, which ends the run; all their stored energy
/// is fractured or damped.
TEST(DynamicRelaxation, BondsBreakBetweenLoadSteps) {
  const double stiffness = 10.0, limit = 0.01;
  const AnalysisBody body = make_chains(6, 2, true, stiffness, limit);
  RelaxationOptions options;
  for (int k = 1; k <= 70; ++k) options.load_factors.push_back(0.001 * k);
  options.load_factors.erase(options.load_factors.begin());  // the default
  options.tolerance = 1e-8;
  const Relaxed outcome = relax(body, options);
  ASSERT_EQ(outcome.result.termination, Termination::collapsed) << outcome.result.reason;
  EXPECT_THAT(outcome.result.reason, testing::HasSubstr("no longer resists the displacements"));
  EXPECT_EQ(outcome.recorder.ends, 1);
  double peak = 0.0;
  for (const ExplicitRecord& row : outcome.recorder.rows) peak = std::max(peak, row.load);
  // Load steps of a sixtieth of the chain's strength; the motion between them overshoots.
  EXPECT_NEAR(peak, 2.0 * stiffness * limit, 0.05 * 2.0 * stiffness * limit);
  EXPECT_GE(outcome.result.last.broken_bonds, 2);
  EXPECT_NEAR(outcome.result.last.load, 0.0, 1e-6);
  EXPECT_GT(outcome.result.last.energy.fractured, 0.0);
  EXPECT_GT(outcome.result.last.energy.external_damping, 0.0);
}

/// A chain that is pulled beyond its limit flies apart.
TEST(DynamicRelaxation, LoadsPullPiecesAway) {
  const AnalysisBody body = make_chains(200, 20, false, 10.0, 0.15);
  RelaxationOptions options;
  options.load_factors = {0.5, 1.0, 2.0};
  options.most_iterations = 20000;
  const Relaxed outcome = relax(body, options);
  EXPECT_EQ(outcome.result.termination, Termination::collapsed) << outcome.result.reason;
  EXPECT_THAT(outcome.result.reason, testing::HasSubstr("load step 3 (load factor 2)"));
  EXPECT_THAT(outcome.result.reason, testing::HasSubstr("the loads pull away"));
  EXPECT_EQ(outcome.recorder.rows.size(), 2U);
}

TEST(DynamicRelaxation, AnIterationLimitIsNoSuccess) {
  const AnalysisBody body = make_chains(40, 2, true, 10.0, INFINITY);
  RelaxationOptions options;
  options.most_iterations = 20;
  const Relaxed outcome = relax(body, options);
  EXPECT_EQ(outcome.result.termination, Termination::failed);
  EXPECT_THAT(outcome.result.reason, testing::HasSubstr("not converged after 20 iterations"));
  EXPECT_TRUE(outcome.recorder.rows.empty());
  EXPECT_EQ(outcome.recorder.ends, 0);
}

/// A chain that is stretched threefold stiffens beyond its step.
TEST(DynamicRelaxation, GrowingMotionIsNoticed) {
  const AnalysisBody body = make_chains(40, 2, false, 10.0, INFINITY);
  AnalysisBody loaded = body;
  for (double& force : loaded.loads.forces) force *= 1e4;
  RelaxationOptions options;
  options.strain = Strain::green;
  const Relaxed outcome = relax(loaded, options);
  EXPECT_EQ(outcome.result.termination, Termination::failed);
  EXPECT_THAT(outcome.result.reason, testing::HasSubstr("the motion grows"));
}

TEST(DynamicRelaxation, ObserversStopItAndTheirExceptionsPass) {
  const AnalysisBody body = make_chains(40, 2, true, 10.0, INFINITY);
  StepRecorder stopping;
  stopping.stops = true;
  EXPECT_EQ(run_dynamic_relaxation(body, {}, stopping).termination, Termination::interrupted);
  StepRecorder breaking;
  breaking.breaks = true;
  const RelaxationResult failed = run_dynamic_relaxation(body, {}, breaking);
  EXPECT_EQ(failed.termination, Termination::failed);
  EXPECT_EQ(failed.reason, "the disk is full");
  StepRecorder full;
  full.most_rows = 2;
  const RelaxationResult kept =
      run_dynamic_relaxation(body, {.load_factors = {0.1, 0.2, 0.3, 0.4}}, full);
  EXPECT_EQ(kept.termination, Termination::failed);
  EXPECT_EQ(kept.reason, "the disk is full");
  EXPECT_EQ(full.rows.size(), 2U);
  EXPECT_EQ(full.ends, 0);
}

TEST(DynamicRelaxation, StatesOfOtherLoadStepsAreRefused) {
  const AnalysisBody body = make_chains(6, 2, true, 10.0, INFINITY);
  RelaxationOptions options;
  options.load_factors = {0.5, 1.0};
  TimeState state;
  StepRecorder nobody;
  EXPECT_THROW(run_dynamic_relaxation(body, options, nobody, &state), std::invalid_argument)
      << "an empty state";
  state.relaxation.load_step = 1;
  state.relaxation.load_factor = 0.4;
  EXPECT_THROW(run_dynamic_relaxation(body, options, nobody, &state), std::invalid_argument);
  state.relaxation.load_factor = 0.5;
  EXPECT_THROW(run_dynamic_relaxation(body, options, nobody, &state), std::invalid_argument)
      << "without a body";
  state.relaxation.load_step = 2;
  EXPECT_THROW(run_dynamic_relaxation(body, options, nobody, &state), std::invalid_argument)
      << "after the last load step";
}

}  // namespace
}  // namespace perilink
