// The tension specimen of Nikravesh & Gerstle (2018) from its case file, against a recorded run and
// against what any sound run of it must show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "model/from_case/lattice_case.hpp"

namespace perilink {
namespace {

class Recorder final : public ExplicitObserver {
 public:
  void on_row(const ExplicitRecord& record, const ExplicitState& state) override {
    rows.push_back(record);
    displacement = state.displacement;
  }
  std::vector<ExplicitRecord> rows;
  std::vector<double> displacement;  ///< in the last row, shape (dim, slots)
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
  const nlohmann::json& margins = reference["margin"];
  const auto expect_near = [&](const char* key, double value) {
    const double expected = reference[key];
    const double margin = margins.value(key, margins["relative"].get<double>());
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
  EXPECT_EQ(run.result.termination, Termination::completed);
  // The study's acceptance: what appears or vanishes is below 1e-4 of the work.
  EXPECT_LT(run.result.largest_surplus, 1e-4);
  for (std::size_t k = 1; k < run.recorder.rows.size(); ++k) {
    const ExplicitRecord &before = run.recorder.rows[k - 1], &row = run.recorder.rows[k];
    EXPECT_GE(row.cracked_particles, before.cracked_particles);
    EXPECT_GE(row.energy.fractured, before.energy.fractured);
  }
}

/// A crack from side to side: but for some pieces particles go all the way with the top or stay
/// with the bottom, and where these meet is a band of few rows.
TEST(ExplicitTension, EndsInACrackAcrossTheBlock) {
  const TensionRun& run = tension_run();
  // At each side a particle hangs on two bonds across the crack, hinges that go on turning.
  EXPECT_LT(std::abs(run.result.last.load), 2e-3 * std::abs(run.result.peak_load));
  const LatticeRows& lattice = run.built.model.lattice;
  double lowest_moving = 1.0, highest_staying = -1.0;
  int pieces = 0;
  for (const Index slot : lattice.particle_slot) {
    const Index at = lattice.at(1, slot);
    const double moved = run.recorder.displacement[at] / run.built.options.reference;
    if (moved > 0.95) {
      lowest_moving = std::min(lowest_moving, lattice.positions[at]);
    } else if (moved < 0.05) {
      highest_staying = std::max(highest_staying, lattice.positions[at]);
    } else {
      ++pieces;
    }
  }
  EXPECT_LT(pieces, 31) << "two rows of the block";
  EXPECT_LT(std::abs(lowest_moving - highest_staying), 5.0 * lattice.spacing);
}

}  // namespace
}  // namespace perilink
