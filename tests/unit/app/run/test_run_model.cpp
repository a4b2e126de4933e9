#include "app/run/run_model.hpp"

#include <gtest/gtest.h>

#include "support/strip_case.hpp"

namespace perilink {
namespace {

/// Counts rows and keeps the last displacements.
class Recorder final : public StepObserver {
 public:
  void on_step(const StepRecord& record, StateSource& source) override {
    ++rows;
    last = record;
    const StepState state = source.state();
    displacement.assign(state.displacement.begin(), state.displacement.end());
  }

  int rows = 0;
  StepRecord last;
  std::vector<double> displacement;
};

TEST(RunModel, AnElasticCaseIsOneRowAtLoadFactorOne) {
  CaseFile input = test::strip_case();
  input.analysis.type = AnalysisType::elastic;
  const Model model = build_model(input);
  Recorder recorder;
  const ModelRun run = run_model(input, model, 1, recorder);
  ASSERT_TRUE(run.elastic.has_value());
  EXPECT_EQ(recorder.rows, 1);
  EXPECT_EQ(recorder.last.load_factor, 1.0);
  EXPECT_EQ(recorder.displacement, run.elastic->displacement);
  EXPECT_EQ(run.result.peak_load, 12.0);
  // Clapeyron: half the load times the displacement that is conjugate to it.
  EXPECT_DOUBLE_EQ(0.5 * run.result.peak_load * run.result.peak_displacement,
                   run.elastic->strain_energy);
}

TEST(RunModel, PhasesOfAnElasticCaseAreTimed) {
  CaseFile input = test::strip_case();
  input.analysis.type = AnalysisType::elastic;
  const Model model = build_model(input);
  Recorder recorder;
  const ElasticSeconds seconds = run_model(input, model, 1, recorder).elastic->seconds;
  EXPECT_GT(seconds.assembly, 0.0);
  EXPECT_GT(seconds.factorization, 0.0);
  EXPECT_GT(seconds.solve, 0.0);
}

TEST(RunModel, ADamageCaseIsFollowedEventByEvent) {
  CaseFile input = test::strip_case();
  input.stop.broken_bonds = 3;
  const Model model = build_model(input);
  Recorder recorder;
  const ModelRun run = run_model(input, model, 1, recorder);
  EXPECT_FALSE(run.elastic.has_value());
  EXPECT_GE(run.result.broken_bonds, 3);
  EXPECT_GT(recorder.rows, 3);
}

}  // namespace
}  // namespace perilink
