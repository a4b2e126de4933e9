#include "analysis/quasistatic/event_run.hpp"

#include <gtest/gtest.h>

#include "io/checkpoint/pack.hpp"
#include "support/analysis_bodies.hpp"
#include "support/staged_bodies.hpp"

namespace perilink::test {
namespace {

/// Restores a state from its bytes, as another process does.
DamageState copied(const DamageState& state) {
  DamageState copy;
  unpack(pack(state), copy);
  return copy;
}

enum class Saves { never, in_memory, in_bytes };

/// Runs a body; goes on from a saved state after every fifth row.
std::vector<StepRecord> rows_of(const AnalysisBody& body, const DamageOptions& options, Saves saves,
                                DamageResult& result) {
  std::vector<StepRecord> rows;
  auto run = std::make_unique<EventRun>(body, options);
  while (const StepRecord* row = run->next()) {
    rows.push_back(*row);
    rows.back().seconds = 0.0;
    if (saves == Saves::never || row->step % 5 != 0) continue;
    DamageState state = run->save();
    if (saves == Saves::in_bytes) state = copied(state);
    try {
      run = std::make_unique<EventRun>(body, options, std::move(state));
    } catch (const SolverError&) {
      // No digits are left for a new factor as the body separates; the run goes on without.
    }
  }
  result = run->result();
  return rows;
}

struct Kind {
  const char* name;
  BlockCase block;
  double event_tolerance = 0.0;
  std::vector<double> load_factors = {};
};

class SavedRun : public ::testing::TestWithParam<Kind> {
 protected:
  SavedRun() : body_(make_block(GetParam().block)) {
    options_.engine.event_tolerance = GetParam().event_tolerance;
    options_.load_factors = GetParam().load_factors;
  }
  AnalysisBody body_;
  DamageOptions options_;
};

/// The bytes of a state hold all of it: every later row has the same bits.
TEST_P(SavedRun, GoesOnAlikeFromItsBytes) {
  DamageResult in_memory, in_bytes;
  const std::vector<StepRecord> rows = rows_of(body_, options_, Saves::in_memory, in_memory);
  const std::vector<StepRecord> others = rows_of(body_, options_, Saves::in_bytes, in_bytes);
  ASSERT_GT(rows.size(), 12U);
  ASSERT_EQ(rows.size(), others.size());
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(pack(rows[k]), pack(others[k])) << k;
  EXPECT_EQ(in_memory.reason, in_bytes.reason);
  EXPECT_EQ(in_memory.peak_load, in_bytes.peak_load);
}

/// A state holds all that matters: a run that goes on from it has the events, loads and energies of
/// one that is never saved. A new factor has the round-off of 1e-10 at most, and a body that is
/// about to separate magnifies it.
TEST_P(SavedRun, HasTheResultsOfOneNeverSaved) {
  DamageResult saved, never;
  const std::vector<StepRecord> rows = rows_of(body_, options_, Saves::in_memory, saved);
  const std::vector<StepRecord> others = rows_of(body_, options_, Saves::never, never);
  ASSERT_EQ(rows.size(), others.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(rows[k].element, others[k].element);
    EXPECT_EQ(rows[k].broken_bonds, others[k].broken_bonds);
    EXPECT_NEAR(rows[k].load, others[k].load, 1e-7 * std::abs(others[k].load));
    EXPECT_NEAR(rows[k].dissipated_energy, others[k].dissipated_energy,
                1e-7 * others.back().external_work);
  }
  EXPECT_EQ(saved.termination, never.termination);
  EXPECT_NEAR(saved.peak_load, never.peak_load, 1e-7 * std::abs(never.peak_load));
}

/// A run that goes on has no cached columns yet, but those of the run that saved it count.
TEST(SavedIterativeRun, KeepsTheLargestSizeOfTheColumnCache) {
  const AnalysisBody body = make_block({.lattice = {}});
  DamageOptions options;
  options.engine.solver = LinearSolver::iterative;
  options.engine.subdomains.edge = 2;
  EventRun run(body, options);
  for (int row = 0; row < 8; ++row) ASSERT_NE(run.next(), nullptr);
  const double bytes = run.result().factor.most_bytes;
  EXPECT_GT(bytes, 0.0);
  EXPECT_EQ(EventRun(body, options, copied(run.save())).result().factor.most_bytes, bytes);
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, SavedRun,
    ::testing::Values(Kind{"brittle", {.lattice = {}}},
                      Kind{"driven", {.lattice = {}, .driven = true}},
                      Kind{"softening", {.lattice = {}, .toothed = true}},
                      Kind{"steps",
                           {.lattice = {}, .toothed = true},
                           0.0,
                           {0.5, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14}},
                      Kind{"closing",
                           {.lattice = {}, .driven = true, .toothed = true, .closing = true}},
                      Kind{"batches", {.lattice = {}, .driven = true, .toothed = true}, 0.01},
                      Kind{"micropolar", {.lattice = {}, .micropolar = true}},
                      Kind{"bar", {.lattice = {}, .driven = true, .bar = true, .toothed = true}}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace perilink::test
