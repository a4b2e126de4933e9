// Events on conjugate gradients are those that a factor finds: the same elements at the same load
// factors, until the body comes apart.

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

/// \param share  so much of the rows
void expect_the_same(const Outcome& found, const Outcome& expected, double share) {
  const auto rows = static_cast<std::size_t>(share * static_cast<double>(expected.rows.size()));
  ASSERT_GE(found.rows.size(), rows) << found.result.reason;
  const double work = std::abs(expected.rows.back().external_work);
  for (std::size_t k = 0; k < rows; ++k) {
    const StepRecord& row = found.rows[k];
    const StepRecord& other = expected.rows[k];
    ASSERT_EQ(row.element, other.element) << k;
    ASSERT_NEAR(row.load_factor, other.load_factor, closeness * other.load_factor) << k;
    ASSERT_NEAR(row.dissipated_energy, other.dissipated_energy, closeness * work) << k;
  }
}

/// In the last events the motions grow without bound, and with them what is left of errors: load
/// factors are then farther apart than 1e-9.
constexpr double before_separation = 0.9;

class Blocks : public testing::TestWithParam<BlockCase> {};

TEST_P(Blocks, BreakAlike) {
  const AnalysisBody body = make_block(GetParam());
  const Outcome expected = outcome_of(body, false, {}), found = outcome_of(body, true, {});
  EXPECT_GT(expected.rows.size(), 50u);
  expect_the_same(found, expected, before_separation);
  EXPECT_EQ(found.rows.size(), expected.rows.size());
  EXPECT_EQ(found.result.ending, expected.result.ending) << found.result.reason;
}

/// Forces that are beyond what a body bears take it apart within a step.
TEST_P(Blocks, BreakAlikeBySteps) {
  if (!GetParam().driven) return;
  const AnalysisBody body = make_block(GetParam());
  const double first = outcome_of(body, false, {}).rows.front().load_factor;
  const std::vector<double> steps = {0.8 * first, 1.1 * first, 1.3 * first};
  expect_the_same(outcome_of(body, true, steps), outcome_of(body, false, steps), 1.0);
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
    [](const auto& block) { return to_string(block.param) + std::to_string(block.index); });

}  // namespace
}  // namespace perilink
