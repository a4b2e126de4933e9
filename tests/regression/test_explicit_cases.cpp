// The tension specimen of Nikravesh & Gerstle (2018) from its case file, against a recorded run and
// against what any sound run of it must show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/explicit_case.hpp"

namespace perilink {
namespace {

class Recorder final : public ExplicitObserver {
 public:
  void on_row(const ExplicitRecord& record, const ExplicitState& state) override {
    rows.push_back(record);
    damage = state.damage;
  }
  std::vector<ExplicitRecord> rows;
  std::vector<double> damage;  ///< of the last row
};

struct TensionRun {
  ExplicitCase built;
  ExplicitResult result;
  Recorder recorder;
};

/// Once for all tests of the process.
const TensionRun& tension_run() {
  static const TensionRun run = [] {
    const CaseFile input = read_case_file(PERILINK_SOURCE_DIR "/meshes/splm_tension.toml");
    TensionRun made{build_explicit_case(input), {}, {}};
    ExplicitState state(made.built.model);
    made.result = run_explicit_analysis(made.built.model, state, made.built.options, made.recorder);
    return made;
  }();
  return run;
}

TEST(ExplicitTension, RepeatsTheRecordedRun) {
  std::ifstream file(PERILINK_SOURCE_DIR "/tests/regression/splm_tension/reference.json");
  const nlohmann::json reference = nlohmann::json::parse(file);
  const TensionRun& run = tension_run();
  EXPECT_EQ(run.built.model.lattice.particles(), reference["particles"]);
  EXPECT_EQ(run.built.bonds, reference["bonds"]);
  const double margin = reference["margin"]["relative"];
  const auto expect_near = [&](const char* key, double value) {
    const double expected = reference[key];
    EXPECT_NEAR(value, expected, margin * std::abs(expected)) << key;
  };
  const EnergyBalance& energy = run.result.last.energy;
  expect_near("critical_time_step", run.result.critical_time_step);
  expect_near("peak_reaction", run.result.peak_load);
  expect_near("external_work", energy.external_work);
  expect_near("dissipated_energy", energy.fractured);
  expect_near("damped_energy", energy.internal_damping + energy.external_damping);
  EXPECT_NEAR(run.result.last.cracked_particles, reference["cracked_particles"].get<double>(),
              reference["margin"]["cracked_particles"].get<double>());
}

TEST(ExplicitTension, BalancesItsEnergyAndNeverHeals) {
  const TensionRun& run = tension_run();
  EXPECT_EQ(run.result.ending, Ending::completed);
  // The study's acceptance: what appears or vanishes is below 1e-4 of the work.
  EXPECT_LT(run.result.largest_surplus, 1e-4);
  for (std::size_t k = 1; k < run.recorder.rows.size(); ++k) {
    const ExplicitRecord &before = run.recorder.rows[k - 1], &row = run.recorder.rows[k];
    EXPECT_GE(row.cracked_particles, before.cracked_particles);
    EXPECT_GE(row.energy.fractured, before.energy.fractured);
  }
}

/// A crack from side to side: in some band as high as two rows the whole width is gone.
TEST(ExplicitTension, EndsInACrackAcrossTheBlock) {
  const TensionRun& run = tension_run();
  EXPECT_LT(std::abs(run.result.last.load), 1e-3 * std::abs(run.result.peak_load));
  const LatticeRows& lattice = run.built.model.lattice;
  std::size_t most = 0;
  for (const LatticeRow& row : lattice.rows) {
    std::size_t gone = 0;
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      gone += run.recorder.damage[slot] > 0.999;
    }
    most = std::max(most, gone);
  }
  EXPECT_GE(most, 14u) << "rows have 15 and 16 particles";
}

}  // namespace
}  // namespace perilink
