// Factor-free events equal those of a factor: the same elements at the same load factors until the
// body separates.

#include <gtest/gtest.h>

#include <cmath>

#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Relative difference of equal load factors; the search detects ties with a smaller tolerance.
constexpr double factor_closeness = 1e-9;

struct Outcome {
  DamageResult result;
  std::vector<StepRecord> rows;
};

Outcome outcome_of(const AnalysisBody& body, bool subdomains, std::vector<double> load_factors) {
  DamageOptions options;
  options.engine.solver = subdomains ? LinearSolver::iterative : LinearSolver::direct;
  options.engine.subdomains.edge = 3;
  options.load_factors = std::move(load_factors);
  Recorder recorder;
  Outcome outcome;
  outcome.result = run(body, options, recorder);
  outcome.rows = recorder.rows;
  return outcome;
}

/// \param share  part of the rows to compare
void expect_the_same(const Outcome& found, const Outcome& expected, double share) {
  const auto rows = static_cast<std::size_t>(share * static_cast<double>(expected.rows.size()));
  ASSERT_GE(found.rows.size(), rows) << found.result.reason;
  const double work = std::abs(expected.rows.back().external_work);
  for (std::size_t k = 0; k < rows; ++k) {
    const StepRecord& row = found.rows[k];
    const StepRecord& other = expected.rows[k];
    ASSERT_EQ(row.element, other.element) << k;
    ASSERT_NEAR(row.load_factor, other.load_factor, factor_closeness * other.load_factor) << k;
    ASSERT_NEAR(row.dissipated_energy, other.dissipated_energy, factor_closeness * work) << k;
  }
}

/// In the last events motions and their errors grow without bound; load factors then differ by more
/// than 1e-9.
constexpr double before_separation = 0.9;

class Blocks : public testing::TestWithParam<BlockCase> {};

TEST_P(Blocks, BreakAlike) {
  const AnalysisBody body = make_block(GetParam());
  const Outcome expected = outcome_of(body, false, {}), found = outcome_of(body, true, {});
  EXPECT_GT(expected.rows.size(), 50u);
  expect_the_same(found, expected, before_separation);
  EXPECT_EQ(found.rows.size(), expected.rows.size());
  EXPECT_EQ(found.result.termination, expected.result.termination) << found.result.reason;
}

/// Forces beyond the strength separate a body within one step.
TEST_P(Blocks, BreakAlikeBySteps) {
  if (!GetParam().driven) return;
  const AnalysisBody body = make_block(GetParam());
  const double first = outcome_of(body, false, {}).rows.front().load_factor;
  const std::vector<double> steps = {0.8 * first, 1.1 * first, 1.3 * first};
  expect_the_same(outcome_of(body, true, steps), outcome_of(body, false, steps), 1.0);
}

/// Returns a block with tension at both ends and three fixed unknowns; its rigid motion is much
/// larger than the stretch of its bonds.
AnalysisBody make_loose_block() {
  AnalysisBody body =
      make_block({{"square", Pattern::rectangular, Surface::none}, false, false, 24});
  const Particles& particles = body.network.particles;
  double end = 0.0, pull = 0.0;
  Index corners[2] = {no_index, no_index};
  std::vector<Index> left;
  for (Index i = 0; i < particles.size(); ++i) {
    end = std::max(end, particles.position(i)[0]);
    pull += body.loads.forces[slot(body, i, 0)];
    if (particles.position(i)[0] < 0.6) left.push_back(i);
  }
  for (const Index i : left) {
    body.loads.forces[slot(body, i, 0)] -= pull / static_cast<double>(left.size());
  }
  corners[0] = left.front();
  corners[1] = left.back();
  number(body,
         [&](Index i, int axis) { return i == corners[0] || (i == corners[1] && axis == 0); });
  return body;
}

/// Errors of cached columns grow with every event that increases motions of the same particles.
/// Checks once subtracted the resulting residual without reporting it, while load factors were
/// wrong by 1e-5.
TEST(EventsWithoutFactor, LooseBodiesBreakAlike) {
  const AnalysisBody body = make_loose_block();
  const Outcome expected = outcome_of(body, false, {}), found = outcome_of(body, true, {});
  EXPECT_GT(expected.rows.size(), 100u);
  expect_the_same(found, expected, before_separation);
  EXPECT_LT(found.result.energy_error, 1e-9);
}

/// Loading plates: stiff parts move rigidly, and single precision loses the digits of the soft
/// parts. Such blocks of columns use double precision.
TEST(EventsWithoutFactor, BodiesWithStiffEndsBreakAlike) {
  for (const double contrast : {1e2, 1e3, 1e5}) {
    AnalysisBody body =
        make_block({{"square", Pattern::rectangular, Surface::none}, false, false, 24});
    Network& network = body.network;
    const auto x_of = [&](Index i) { return network.particles.position(i)[0]; };
    double end = 0.0;
    for (Index i = 0; i < network.particles.size(); ++i) end = std::max(end, x_of(i));
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (x_of(network.bonds.first[b]) + x_of(network.bonds.second[b]) < 1.2 * end) continue;
      network.stiffness[b] *= contrast;
      network.critical_stretch[b] = infinity;
    }
    const Outcome expected = outcome_of(body, false, {}), found = outcome_of(body, true, {});
    EXPECT_GT(expected.rows.size(), 50u);
    SCOPED_TRACE(contrast);
    expect_the_same(found, expected, contrast < 1e5 ? before_separation : 0.5);
  }
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
