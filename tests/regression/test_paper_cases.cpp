// The three cases of Gerstle, Sau & Silling (2005) against recorded runs, and against what any
// sound run of them must show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

namespace perilink {
namespace {

/// Keeps the rows of a run.
class Recorder final : public StepObserver {
 public:
  void on_step(const StepRecord& record, StateSource&) override { rows.push_back(record); }
  std::vector<StepRecord> rows;
};

struct PaperRun {
  Model model;
  DamageResult result;
  std::vector<StepRecord> rows;

  /// Elements in the order of failing.
  std::vector<Index> failed() const {
    std::vector<Index> elements;
    for (const StepRecord& row : rows) elements.push_back(row.element);
    elements.resize(std::min(elements.size(), static_cast<std::size_t>(result.broken_bonds)));
    return elements;
  }
  double middle(Index element, int axis) const {
    const Network& network = model.network;
    return 0.5 * (network.particles.position(network.bonds.first[element])[axis] +
                  network.particles.position(network.bonds.second[element])[axis]);
  }
};

/// Each case is run once for all tests of the process.
const PaperRun& run_of(const std::string& name) {
  static std::map<std::string, PaperRun> runs;
  const auto found = runs.find(name);
  if (found != runs.end()) return found->second;
  const CaseFile input = read_case_file(PERILINK_SOURCE_DIR "/meshes/" + name + ".toml");
  PaperRun run{build_model(input), {}, {}};
  Recorder recorder;
  const Model& model = run.model;
  run.result = run_damage_analysis(model, damage_options(input, 1), recorder);
  run.rows = std::move(recorder.rows);
  return runs.emplace(name, std::move(run)).first->second;
}

class PaperCases : public testing::TestWithParam<const char*> {};

TEST_P(PaperCases, RepeatTheRecordedRun) {
  const std::string name = GetParam();
  std::ifstream file(PERILINK_SOURCE_DIR "/tests/regression/" + name + "/reference.json");
  const nlohmann::json reference = nlohmann::json::parse(file);
  const PaperRun& run = run_of(name);
  const double margin = reference["margin"]["relative"];
  const auto expect_near = [&](const char* key, double value) {
    const double expected = reference[key];
    EXPECT_NEAR(value, expected, margin * std::abs(expected)) << key;
  };
  expect_near("peak_load", run.result.peak_load);
  expect_near("peak_displacement", run.result.peak_displacement);
  expect_near("initial_stiffness", run.result.initial_stiffness);
  expect_near("dissipated_energy", run.result.last.dissipated_energy);
  EXPECT_EQ(to_string(run.result.termination), reference["status"]);
  EXPECT_EQ(run.result.broken_bonds, reference["broken_bonds"]);

  const auto first = reference["first_broken"].get<std::vector<Index>>();
  ASSERT_EQ(first.size(), 50u);
  std::vector<Index> failed = run.failed();
  failed.resize(std::min(failed.size(), first.size()));
  EXPECT_EQ(failed, first);
}

TEST_P(PaperCases, BalanceTheirEnergy) {
  const PaperRun& run = run_of(GetParam());
  // Round-off of some hundred downdates, enlarged by the condition of a body about to separate.
  EXPECT_LT(run.result.energy_error, 1e-9);
  EXPECT_LT(run.result.largest_residual, 1e-9);
  double dissipated = 0.0;
  for (const StepRecord& row : run.rows) {
    EXPECT_GE(row.dissipated_energy, dissipated) << "row " << row.step;
    dissipated = row.dissipated_energy;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PaperCases,
                         testing::Values("block_tension", "block_compression", "rc_cantilever"),
                         [](const auto& name) { return std::string(name.param); });

TEST(PaperTension, EndsInOneCrackAcrossTheMiddle) {
  const PaperRun& run = run_of("block_tension");
  EXPECT_EQ(run.result.termination, Termination::collapsed);
  const std::vector<Index> failed = run.failed();
  ASSERT_GT(failed.size(), 50u);
  std::vector<double> x;
  double lowest = INFINITY, highest = -INFINITY, mean = 0.0;
  for (const Index e : failed) {
    const double y = run.middle(e, 1);
    x.push_back(run.middle(e, 0));
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
    mean += y / static_cast<double>(failed.size());
  }
  // All within 1.5 horizons of one height, in the middle third of the specimen's 200 in.
  EXPECT_LE(highest - lowest, 2.0 * 1.5 * run.model.horizon);
  EXPECT_GT(mean, 200.0 / 3.0);
  EXPECT_LT(mean, 400.0 / 3.0);
  // From side to side without a gap of more than one spacing.
  std::sort(x.begin(), x.end());
  EXPECT_LT(x.front(), run.model.lattice.spacing);
  EXPECT_GT(x.back(), 100.0 - run.model.lattice.spacing);
  for (std::size_t k = 1; k < x.size(); ++k) {
    EXPECT_LE(x[k] - x[k - 1], 1.001 * run.model.lattice.spacing);
  }
}

TEST(PaperTension, SoftensAfterItsPeak) {
  const PaperRun& run = run_of("block_tension");
  EXPECT_LT(std::abs(run.rows.back().load), 0.01 * run.result.peak_load);
}

/// Plain concrete bears more in compression than in tension.
TEST(PaperCompression, IsStrongerThanTension) {
  EXPECT_GT(run_of("block_compression").result.peak_load, run_of("block_tension").result.peak_load);
  // Intact bodies of one lattice are as stiff in either direction.
  EXPECT_NEAR(run_of("block_compression").result.initial_stiffness,
              run_of("block_tension").result.initial_stiffness,
              1e-9 * run_of("block_tension").result.initial_stiffness);
}

/// Bonds that break by stretching only must lie across the load.
TEST(PaperCompression, BreaksBondsAcrossTheLoad) {
  const PaperRun& run = run_of("block_compression");
  for (const Index e : run.failed()) {
    const auto direction = run.model.network.bonds.direction(e);
    EXPECT_GE(std::abs(direction[0]), std::abs(direction[1])) << "element " << e;
  }
}

TEST(PaperCantilever, CracksOnTheTensionSideFirst) {
  const PaperRun& run = run_of("rc_cantilever");
  const std::vector<Index> failed = run.failed();
  ASSERT_GE(failed.size(), 25u);
  for (int k = 0; k < 25; ++k) EXPECT_LT(run.middle(failed[k], 0), 50.0) << "break " << k + 1;
}

/// The bar carries the tension that the cracked concrete gives up: without it the first crack is
/// about as much as the beam bears.
TEST(PaperCantilever, BearsMoreThanItsFirstCrackThanksToItsBar) {
  const PaperRun& run = run_of("rc_cantilever");
  EXPECT_GT(run.result.peak_load, 1.2 * run.rows.front().load);
  CaseFile plain = read_case_file(PERILINK_SOURCE_DIR "/meshes/rc_cantilever.toml");
  plain.rebar.clear();
  const Model model = build_model(plain);
  Recorder recorder;
  const DamageResult result = run_damage_analysis(model, damage_options(plain, 1), recorder);
  EXPECT_LT(result.peak_load, 0.8 * run.result.peak_load);
  EXPECT_LT(result.peak_load, 1.2 * recorder.rows.front().load);
}

}  // namespace
}  // namespace perilink
