// Events on conjugate gradients are those that a factor finds: the same elements at the same load
// factors, to collapse.

#include <gtest/gtest.h>

#include <cmath>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Load factors that agree to this are the same; ties of the search are narrower.
constexpr double closeness = 1e-9;

struct Outcome {
  DamageResult result;
  std::vector<StepRecord> rows;
};

Outcome outcome_of(const AnalysisBody& body, bool boxes, std::vector<double> load_factors) {
  DamageOptions options;
  options.engine.solver = boxes ? LinearSolver::iterative : LinearSolver::direct;
  options.engine.boxes.edge = 3;
  options.load_factors = std::move(load_factors);
  Recorder recorder;
  Outcome outcome;
  outcome.result = run(body, options, recorder);
  outcome.rows = recorder.rows;
  return outcome;
}

void expect_the_same(const Outcome& found, const Outcome& expected) {
  EXPECT_EQ(found.result.ending, expected.result.ending) << found.result.reason;
  EXPECT_EQ(found.result.broken_bonds, expected.result.broken_bonds);
  ASSERT_EQ(found.rows.size(), expected.rows.size());
  const double work = std::abs(expected.rows.back().external_work);
  for (std::size_t k = 0; k < found.rows.size(); ++k) {
    const StepRecord& row = found.rows[k];
    const StepRecord& other = expected.rows[k];
    ASSERT_EQ(row.element, other.element) << k;
    ASSERT_NEAR(row.load_factor, other.load_factor, closeness * other.load_factor) << k;
    ASSERT_NEAR(row.dissipated_energy, other.dissipated_energy, closeness * work) << k;
  }
}

class Blocks : public testing::TestWithParam<BlockCase> {};

TEST_P(Blocks, BreakAlike) {
  const AnalysisBody body = make_block(GetParam());
  const Outcome expected = outcome_of(body, false, {}), found = outcome_of(body, true, {});
  EXPECT_GT(expected.rows.size(), 50u);
  expect_the_same(found, expected);
  EXPECT_LT(found.result.energy_error, closeness);
}

TEST_P(Blocks, BreakAlikeBySteps) {
  const AnalysisBody body = make_block(GetParam());
  const double first = outcome_of(body, false, {}).rows.front().load_factor;
  const std::vector<double> steps = {0.8 * first, 1.1 * first, 1.3 * first};
  expect_the_same(outcome_of(body, true, steps), outcome_of(body, false, steps));
}

const LatticeCase hexagonal{"hexagonal", Pattern::hexagonal, Surface::none};
const LatticeCase square{"square", Pattern::rectangular, Surface::none};
const LatticeCase cubic{"cubic", Pattern::cubic, Surface::none};

INSTANTIATE_TEST_SUITE_P(
    All, Blocks,
    testing::Values(BlockCase{hexagonal, false, false, 10}, BlockCase{hexagonal, true, true, 10},
                    BlockCase{square, true, false, 10, 0.0}, BlockCase{cubic, false, false, 5},
                    BlockCase{cubic, true, false, 5, 0.1, false, true},
                    BlockCase{square, true, false, 8, 0.1, true, true},
                    BlockCase{cubic, true, false, 4, 0.1, true},
                    BlockCase{square, true, false, 9, 0.1, false, true, true}),
    [](const auto& info) { return to_string(info.param) + std::to_string(info.index); });

}  // namespace
}  // namespace perilink
