// Elements that fail together within a tolerance of the load factor give the results of single
// events in fewer rows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/text/csv.hpp"
#include "support/notched_beams.hpp"
#include "support/replaced.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

using namespace test;

/// Results of a run. Runs of one test share a directory, so each is read before the next one.
struct RunResults {
  explicit RunResults(const std::string& text, int threads = 1) {
    const WholeRun run(text, threads);
    summary = run.summary.json;
    bytes = read_text(run.work / "history.csv");
    table = run.history();
  }
  double told(const char* key) const { return summary.at(key).get<double>(); }
  double rows() const { return static_cast<double>(table.rows.size()); }
  std::vector<double> history(const std::string& name) const {
    const auto column = static_cast<std::size_t>(table.column(name));
    std::vector<double> values;
    for (const auto& row : table.rows) values.push_back(row.at(column));
    return values;
  }

  nlohmann::json summary;
  std::string bytes;
  CsvTable table;
};

/// Checks that rows count their events and that work equals stored plus dissipated energy in each.
void expect_consistent_rows(const RunResults& run) {
  EXPECT_LT(run.told("energy_error"), 1e-9);
  const auto events = run.history("events"), broken = run.history("broken_bonds"),
             softened = run.history("yield_events"), residual = run.history("residual"),
             element = run.history("element"), work = run.history("external_work"),
             stored = run.history("strain_energy"), lost = run.history("dissipated_energy");
  const bool hosts = run.table.column("freed_energy") >= 0;
  const auto freed = hosts ? run.history("freed_energy") : std::vector<double>(work.size());
  const double most = *std::ranges::max_element(work);
  double largest = 0.0;
  for (std::size_t k = 0; k + 1 < events.size(); ++k) {
    const double before = broken[k] + softened[k], after = broken[k + 1] + softened[k + 1];
    EXPECT_LE(residual[k], 1e-10);
    EXPECT_NEAR(work[k], stored[k] + lost[k] + freed[k], 1e-9 * most) << "row " << k + 1;
    if (element[k] < 0.0) continue;  // end of a stage
    EXPECT_EQ(before + events[k], after) << "row " << k + 1;
    largest = std::max(largest, events[k]);
  }
  EXPECT_GT(largest, 5.0) << "hardly anything fails together";
}

struct ToleratedCase {
  std::string name;
  NotchedBeam beam;
  double tolerance = 0.02;
  double fewer_rows = 5.0;  ///< least ratio of the numbers of rows
};

std::ostream& operator<<(std::ostream& out, const ToleratedCase& tolerated) {
  return out << tolerated.name;
}

class Tolerated : public testing::TestWithParam<ToleratedCase> {};

/// Measured: smoothed peaks differ by at most 1.1 %, energies by 1.4 %.
TEST_P(Tolerated, RunsTellTheSameInFewerRows) {
  NotchedBeam beam = GetParam().beam;
  const RunResults exact(notched_beam_case(beam));
  beam.tolerance = GetParam().tolerance;
  const RunResults run(notched_beam_case(beam));
  expect_consistent_rows(run);
  EXPECT_GT(exact.rows(), GetParam().fewer_rows * run.rows());
  const auto expect_near = [&](const char* key, double part) {
    const double expected = exact.told(key);
    EXPECT_NEAR(run.told(key), expected, part * std::abs(expected)) << key;
  };
  expect_near("peak_load", 0.015);
  expect_near("smoothed_peak_load", 0.015);
  expect_near("dissipated_energy", 0.03);
  expect_near("external_work", 0.03);
}

std::vector<ToleratedCase> tolerated_cases() {
  NotchedBeam forced, micropolar, embedded, reinforced, staged;
  forced.force = 10.0;
  micropolar.model = "micropolar";
  embedded.sections = "[elements]\nsize = 5\n";
  reinforced.sections =
      "[[rebar]]\nfrom = [0, 5]\nto = [120, 5]\narea = 0.05\nyoungs_modulus = 200000\n"
      "yield_strength = 200\n";
  reinforced.stop = "displacement = 0.25";
  staged.weight = 3.0;
  return {{"driven", {}},
          {"forced", forced, 0.02, 4.5},
          {"micropolar", micropolar, 0.005, 2.0},  // snap-back: 0.02 dissipates 6 % less
          {"carried", embedded},
          {"reinforced", reinforced},
          {"staged", staged}};
}

INSTANTIATE_TEST_SUITE_P(Beams, Tolerated, testing::ValuesIn(tolerated_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(EventBatches, OfBrittleBondsAreSingleEvents) {
  NotchedBeam beam;
  beam.spacing = 5.0;
  const std::string brittle = replaced(notched_beam_case(beam), "softening = \"linear\"\n", "");
  const std::string text = replaced(brittle, "tensile_strength = 3.0\n", "");
  const RunResults zero(text);
  const std::string bytes = zero.bytes;
  EXPECT_GT(zero.rows(), 20.0);
  EXPECT_EQ(RunResults(replaced(text, "event_tolerance = 0\n", "")).bytes, bytes);
}

/// With a tiny tolerance only exact ties fail together.
TEST(EventBatches, OfATinyToleranceAreSingleEvents) {
  NotchedBeam beam;
  beam.spacing = 5.0;
  const RunResults exact(notched_beam_case(beam));
  beam.tolerance = 1e-9;
  const RunResults run(notched_beam_case(beam));
  EXPECT_NEAR(run.told("dissipated_energy"), exact.told("dissipated_energy"),
              1e-6 * exact.told("dissipated_energy"));
  EXPECT_NEAR(run.told("peak_load"), exact.told("peak_load"), 1e-6 * exact.told("peak_load"));
}

TEST(EventBatches, GiveTheSameBytesForAnyNumberOfThreads) {
  NotchedBeam beam;
  beam.tolerance = 0.02;
  const std::string one = RunResults(notched_beam_case(beam)).bytes;
  for (const int threads : {2, 3}) {
    EXPECT_EQ(RunResults(notched_beam_case(beam), threads).bytes, one);
  }
}

/// Loads of steps differ by at most 2.1 %, beyond the peak (measured).
TEST(EventBatches, EndStepsAtTheirLoads) {
  NotchedBeam beam;
  beam.analysis =
      "control = \"steps\"\nload_factors = [0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6]\n";
  const RunResults exact(notched_beam_case(beam));
  beam.tolerance = 0.02;
  const RunResults run(notched_beam_case(beam));
  const auto expected = exact.history("load"), loads = run.history("load");
  ASSERT_EQ(loads.size(), expected.size());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    EXPECT_NEAR(loads[k], expected[k], 0.02 * expected[k]) << "step " << k + 1;
  }
  EXPECT_LT(run.told("energy_error"), 1e-9);
  EXPECT_EQ(run.history("load_factor"), exact.history("load_factor"));
}

/// Bonds tie by symmetry here; round-off must not decide about batches.
TEST(EventBatches, AreTheSameWithoutAFactor) {
  const RunResults direct(notched_bar_case("direct", 0.02));
  const RunResults found(notched_bar_case("iterative", 0.02));
  ASSERT_EQ(found.rows(), direct.rows());
  EXPECT_GT(direct.rows(), 100.0);
  for (const char* name : {"load", "displacement", "dissipated_energy", "external_work"}) {
    const auto expected = direct.history(name), values = found.history(name);
    const double size = *std::ranges::max_element(expected);
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_NEAR(values[k], expected[k], 1e-6 * size) << name << " of row " << k + 1;
    }
  }
  EXPECT_EQ(found.history("events"), direct.history("events"));
  expect_consistent_rows(direct);
  expect_consistent_rows(found);
}

}  // namespace
}  // namespace perilink
