// Bonds of three teeth through the whole program: implicit and explicit runs, fields, pictures and
// their comparison.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "support/process.hpp"
#include "support/softening_strips.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;

class SofteningRuns : public testing::Test {
 protected:
  SofteningRuns() {
    fs::create_directories(work());
    SofteningStrip strip;
    strip.softening = "softening = \"linear\"\nsoftening_error = 0.6";
    strip.length = 60.0;
    strip.width = 30.0;
    strip.fracture_energy = 0.02;
    strip.pull = 0.02;
    strip.more = "[stop]\nload_fraction = 0.002\n[output]\nfields_every = 30";
    write_text(work() / "implicit.toml", softening_case(strip));
    // Twenty-four fundamental periods of 0.25 ms.
    strip.more =
        "type = \"explicit\"\nduration = 0.006\nrows = 400\n[output]\n"
        "fields_times = [0.002, 0.003, 0.004, 0.005, 0.006]";
    write_text(work() / "explicit.toml", softening_case(strip));
  }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  void run_case(const std::string& name) const {
    const ProcessEnd end = run({"run", name + ".toml", "--out", name, "--quiet"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(read_text(work() / directory / "summary.json"));
  }
  /// Damage of all particles, one list for each file of fields.
  std::vector<std::vector<double>> damage(const std::string& directory) const {
    std::vector<std::vector<double>> result;
    for (const PvdEntry& entry : read_pvd((work() / directory / "fields.pvd").string())) {
      const VtuGrid grid = read_vtu((work() / directory / entry.file).string());
      result.push_back(grid.find_point_data("damage")->values);
    }
    return result;
  }
  void expect_rising_damage(const std::string& directory) const {
    const auto series = damage(directory);
    ASSERT_GT(series.size(), 3U);
    for (std::size_t k = 0; k < series.size(); ++k) {
      for (std::size_t i = 0; i < series[k].size(); ++i) {
        EXPECT_GE(series[k][i], k == 0 ? 0.0 : series[k - 1][i]);
        EXPECT_LE(series[k][i], 1.0);
      }
    }
    const auto largest = std::max_element(series.back().begin(), series.back().end());
    EXPECT_GT(*largest, 0.4);
  }

  TemporaryDirectory temporary_;
};

TEST_F(SofteningRuns, CheckTellsTheirStrengthAndTeeth) {
  const ProcessEnd end = run({"check", "implicit.toml"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  // E G / f^2 = 30000 * 0.02 / 3^2.
  EXPECT_THAT(end.out, testing::HasSubstr("tensile strength   3, process zone E G/f^2 = 66.6"));
  EXPECT_THAT(end.out, testing::HasSubstr(" in 3 teeth"));
}

TEST_F(SofteningRuns, LoseTheirStiffnessInThreeSteps) {
  run_case("implicit");
  const CsvTable history = read_csv((work() / "implicit/history.csv").string());
  const auto column = [&](const std::string& name) {
    std::vector<double> values;
    for (const auto& row : history.rows) values.push_back(row.at(history.column(name)));
    return values;
  };
  const std::vector<double> broken = column("broken_bonds"), softened = column("yield_events");
  for (std::size_t k = 1; k < broken.size(); ++k) {
    EXPECT_EQ(broken[k] + softened[k], broken[k - 1] + softened[k - 1] + 1.0) << "one event a row";
  }
  // Two events before each break, and bonds that never get there.
  EXPECT_GE(softened.back(), 2.0 * broken.back());
  expect_rising_damage("implicit");
}

TEST_F(SofteningRuns, ExplicitOnesBearTheSame) {
  run_case("implicit");
  run_case("explicit");
  const nlohmann::json implicit = summary("implicit"), moved = summary("explicit");
  // Measured 0.3 %: the mass of the strip.
  EXPECT_NEAR(moved["peak_load"].get<double>(), implicit["peak_load"].get<double>(),
              0.03 * implicit["peak_load"].get<double>());
  EXPECT_LT(implicit["energy_error"].get<double>(), 1e-9);
  // Bonds that close and open between two instants are off by the square of the step.
  EXPECT_LT(moved["energy_error"].get<double>(), 2e-3);
  expect_rising_damage("explicit");

  ASSERT_EQ(run({"plot", "implicit"}).exit_status, 0);
  EXPECT_THAT(read_text(work() / "implicit/load_displacement.svg"), testing::HasSubstr("peak"));
  const ProcessEnd end = run({"compare", "implicit", "explicit", "--out", "both"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, testing::HasSubstr("crack overlap"));
  EXPECT_TRUE(fs::exists(work() / "both/compare.svg"));
}

}  // namespace
}  // namespace perilink::test
