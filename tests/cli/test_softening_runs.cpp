// Bonds of three segments through the whole program: implicit and explicit runs, fields, pictures
// and their comparison.

#include <fmt/format.h>
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
  EXPECT_THAT(end.out, testing::HasSubstr(" in 3 segments"));
  EXPECT_THAT(end.out, testing::HasSubstr("fracture energy    0.02\n"));
  EXPECT_THAT(end.out, testing::ContainsRegex("breakable bonds    [0-9]+, which soften\n"));
  EXPECT_THAT(end.out, testing::Not(testing::HasSubstr("critical stretch ")));
}

TEST_F(SofteningRuns, CheckExpectsTheBatchesOfACrack) {
  for (const char* solver : {"direct", "iterative"}) {
    const std::string setting = std::string("analysis.solver=") + solver;
    const ProcessEnd end = run({"check", "implicit.toml", "--set", setting});
    ASSERT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out, testing::HasSubstr(" ms per batch of events; ")) << solver;
    EXPECT_THAT(end.out, testing::HasSubstr(" for a crack across the body, about ")) << solver;
  }
  const ProcessEnd bars = run({"check", PERILINK_SOURCE_DIR "/meshes/corbel.toml"});
  EXPECT_THAT(bars.out, testing::HasSubstr(" for each crack across the body, about "));
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
  const std::vector<double> events = column("events");
  for (std::size_t k = 1; k < broken.size(); ++k) {
    EXPECT_EQ(broken[k] + softened[k], broken[k - 1] + softened[k - 1] + events[k - 1]);
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

/// A block of 50 by 100 with a closed crack across it, under a weight of 1000, pushed at its top:
/// it turns about the particle at (50, 25), which is held along the crack since closed faces slide,
/// with half the width and 75 of height as its arms.
std::string rocking_block(const std::string& push, const std::string& stages) {
  return R"(regions = [
  {name = "block", x = [0, 50], y = [0, 100]},
  {name = "bottom", x = [0, 50], y = [0, 0]},
  {name = "top", x = [0, 50], y = [100, 100]},
  {name = "toe", x = [50, 50], y = [25, 25]},
  {name = "corner", x = [0, 0], y = [100, 100]},
]
[body]
problem = "plane_stress"
thickness = 10
spacing = 5
horizon_ratio = 3
[[materials]]
region = "block"
youngs_modulus = 30000
fracture_energy = 1e6
closing = true
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[supports]]
region = "toe"
fix = ["x"]
[[cracks]]
points = [[-1, 22.5], [51, 22.5]]
[[loads]]
region = "top"
force = [0, -1000]
stage = "weight"
)" + push +
         R"(
stage = "push"
[[stages]]
name = "weight"
to = 1
[[stages]]
name = "push"
)" + stages;
}

constexpr const char* driven_corner = "[[displacements]]\nregion = \"corner\"\nx = 0.01";

TEST_F(SofteningRuns, ARockingBlockIsAMechanismWhoseLoadStays) {
  write_text(work() / "driven.toml", rocking_block(driven_corner, "to = 500\n"));
  write_text(work() / "forced.toml",
             rocking_block("[[loads]]\nregion = \"corner\"\nforce = [10, 0]", "to = 500\n"));
  for (const std::string name : {"driven", "forced"}) {
    run_case(name);
    const nlohmann::json result = summary(name);
    EXPECT_EQ(result["status"], "collapsed");
    EXPECT_THAT(result["reason"].get<std::string>(), testing::HasSubstr("a mechanism: "));
    // Round-off at a pivot of zero.
    EXPECT_NEAR(result["peak_load"].get<double>(), 1000.0 * 25.0 / 75.0, 1e-6);
    EXPECT_THAT(result["notes"].dump(), testing::HasSubstr("only their closed faces"));
  }
  EXPECT_THAT(summary("driven")["reason"].get<std::string>(), testing::HasSubstr("at 333.333"));
}

TEST_F(SofteningRuns, StagesEndAtALoad) {
  write_text(work() / "back.toml", rocking_block(driven_corner,
                                                 "to_load = 200\n[[stages]]\nname = \"back\"\n"
                                                 "loads = \"push\"\nto_load = 0\n"));
  run_case("back");
  const nlohmann::json result = summary("back");
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["reason"], "the load reached 0");
  EXPECT_EQ(result["stages"][1]["reason"], "the load reached 200");
  EXPECT_EQ(result["stages"][2]["loads"], "push");
  // Round-off of sums of reactions as large as the weight.
  EXPECT_NEAR(result["stages"][1]["load"].get<double>(), 200.0, 1e-9);
  EXPECT_NEAR(result["stages"][2]["load"].get<double>(), 0.0, 1e-9);
}

/// A closed crack leaves one layer of a bond-based body, about which the load turns a half.
TEST(CrackedRuns, NameTheCrackThatLeavesAHinge) {
  const std::string hinge = R"([body]
problem = "three_dimensional"
surface = "none"
spacing = 4
horizon_ratio = 1.8
[[regions]]
name = "beam"
x = [0, 32]
y = [0, 16]
z = [0, 8]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 16]
z = [0, 8]
[[regions]]
name = "right"
x = [32, 32]
y = [0, 16]
z = [0, 8]
[[materials]]
region = "beam"
youngs_modulus = 20000
fracture_energy = 0.1
tensile_strength = 2
[[cracks]]
corners = [[14, 15, -1], [14, 15, 9], [14, -1, 9], [14, -1, -1]]
[[supports]]
region = "left"
fix = ["x", "y", "z"]
[[tractions]]
region = "right"
traction = [1, 0, 0]
[stop]
broken_bonds = 3
)";
  const std::string before = hinge.substr(0, hinge.find("[[cracks]]"));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const TemporaryDirectory work;
  for (const char* type : {"damage", "elastic"}) {
    const std::string ending = fmt::format("[analysis]\ntype = \"{}\"\n", type);
    write_text(work / "hinge.toml",
               hinge.substr(0, type[0] == 'd' ? hinge.npos : hinge.find("[stop]")) + ending);
    const ProcessEnd end = run_program(work.path(), {"run", "hinge.toml", "--out", "r", "--force"});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, testing::HasSubstr(fmt::format("hinge.toml:{}: cracks[1]", line)));
    EXPECT_THAT(end.err, testing::HasSubstr("as about a hinge"));
    EXPECT_THAT(read_text(work / "r/summary.json"), testing::HasSubstr("\"failed\""));
  }
}

}  // namespace
}  // namespace perilink::test
