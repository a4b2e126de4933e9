#include "app/run/bond_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "analysis/dynamics/fundamental_period.hpp"
#include "base/error.hpp"
#include "solver/factor_routes.hpp"
#include "support/replaced.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

/// A block that is pulled until it breaks, with a gauge of its elongation.
constexpr const char* pulled_block = R"(regions = [
  {name = "block", x = [0, 1], y = [0, 1]},
  {name = "bottom", x = [0, 1], y = [0, 0]},
  {name = "top", x = [0, 1], y = [1, 1]},
]
[body]
spacing = 0.1
horizon_ratio = 3
[[materials]]
region = "block"
youngs_modulus = 30
fracture_energy = 0.0001
density = 2.5
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[displacements]]
region = "top"
y = 0.05
[[gauges]]
name = "elongation"
between = [[0.5, 0], [0.5, 1]]
[analysis]
type = "explicit"
duration = 8
damping_rate = 0.5
rows = 40
[output]
fields_times = [4]
)";

class BondRunTest : public testing::Test {
 protected:
  BondRunTest()
      : input_(parse_case(pulled_block, "")),
        model_(build_model(input_)),
        built_(build_bond_run(input_, model_)) {}

  CaseFile input_;
  Model model_;
  BondRunCase built_;
};

/// The slowest vibration of a block that is held below is about the shear wave four times its
/// height long; a block as wide as high bends as well.
TEST_F(BondRunTest, StepsAndPeriodFollowFromTheMaterial) {
  const double shear_speed = std::sqrt(30.0 / (2.0 * (1.0 + 1.0 / 3.0)) / 2.5);
  const double period = fundamental_period(model_.network, model_.unknowns, built_.inertia);
  EXPECT_GT(period, 4.0 / shear_speed);
  EXPECT_LT(period, 8.0 / shear_speed);
  EXPECT_DOUBLE_EQ(built_.options.time_step, 0.9 * built_.inertia.critical_time_step());
  EXPECT_EQ(built_.options.steps(), static_cast<Index>(std::ceil(8.0 / built_.options.time_step)));
  // A wave crosses a spacing in about a step.
  const double wave = 0.1 / std::sqrt(30.0 / 2.5);
  EXPECT_GT(built_.inertia.critical_time_step(), 0.3 * wave);
  EXPECT_LT(built_.inertia.critical_time_step(), 2.0 * wave);
}

TEST_F(BondRunTest, UniformMassesAllowLongerSteps) {
  const CaseFile uniform =
      parse_case(replaced(pulled_block, "rows = 40", "masses = \"uniform\""), "");
  EXPECT_GT(build_bond_run(uniform, model_).inertia.critical_time_step(),
            built_.inertia.critical_time_step());
}

TEST_F(BondRunTest, RulesAreThoseOfTheCase) {
  EXPECT_EQ(built_.rules.damping_rate, 0.5);
  EXPECT_EQ(built_.rules.strain, Strain::small);
  EXPECT_FALSE(built_.rules.constant_velocity);
  const std::string text = replaced(pulled_block, "[[displacements]]", "[[velocities]]");
  const CaseFile input = parse_case(replaced(text, "rows = 40", "strain = \"green\""), "");
  const BondRunCase built = build_bond_run(input, model_);
  EXPECT_EQ(built.rules.strain, Strain::green);
  EXPECT_TRUE(built.rules.constant_velocity);
  EXPECT_LT(built.inertia.critical_time_step(), built_.inertia.critical_time_step());
}

TEST_F(BondRunTest, UnstableAndEndlessRunsAreRefused) {
  const auto message = [&](const std::string& key) {
    const CaseFile input = parse_case(replaced(pulled_block, "rows = 40", key), "");
    try {
      build_bond_run(input, model_);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("time_step = 1"), testing::HasSubstr("critical time step"));
  EXPECT_THAT(message("time_step = 1e-12"), testing::HasSubstr("are possible"));
}

TEST_F(BondRunTest, HistoryHasARowForEveryRowAndTheGauge) {
  const test::WholeRun run(input_);
  EXPECT_EQ(run.summary.json["status"], "completed");
  const CsvTable table = run.history();
  EXPECT_EQ(static_cast<Index>(table.rows.size()), run.run->files().rows());
  const int broken = table.column("broken_bonds"), gauge = table.column("elongation");
  const int displacement = table.column("displacement"), load = table.column("load");
  ASSERT_GE(gauge, 0);
  EXPECT_GT(table.rows.back()[broken], 0.0);
  double peak = 0.0;
  for (const auto& row : table.rows) {
    EXPECT_NEAR(row[gauge], row[displacement], 1e-14) << "the top is driven, the bottom held";
    peak = std::max(peak, std::abs(row[load]));
  }
  EXPECT_EQ(std::abs(run.summary.json["peak_load"].get<double>()), peak);
}

TEST_F(BondRunTest, FieldsShowTheMomentTheyAreOf) {
  const test::WholeRun run(input_);
  const std::vector<PvdEntry> series = run.series();
  ASSERT_EQ(series.size(), 3U) << "the first row, the time asked for, the last";
  EXPECT_GE(series[1].time, 4.0 * (1.0 - 1e-9));
  const VtuGrid last = run.fields(2);
  const auto largest = [&](const char* name) {
    const std::vector<double>& values = last.find_point_data(name)->values;
    return *std::max_element(values.begin(), values.end());
  };
  EXPECT_GE(largest("displacement"), 0.05 * (1.0 - 1e-6))
      << "as large as it is, not divided by a load factor";
  EXPECT_GT(largest("damage"), 0.0);
  EXPECT_EQ(last.field("time", -1.0), series[2].time);
  EXPECT_EQ(last.field("load_factor", -1.0), run.history().rows.back()[2]);
  EXPECT_GT(run.summary.json["broken_bonds"], 0);
}

/// The crack grows for hundreds of steps between the field files.
TEST_F(BondRunTest, FieldsNumberBreaksInTheOrderOfTime) {
  class Order final : public BondRunObserver {
   public:
    void on_row(const ExplicitRecord&, const BondRunState& state) override {
      const std::vector<double> secants = state.bonds.secants();
      for (Index e = 0; e < state.network.num_elements(); ++e) {
        if (secants[e] == 0.0 && !std::count(broken.begin(), broken.end(), e)) broken.push_back(e);
      }
    }
    std::vector<Index> broken;
  } order;
  const test::WholeRun run(input_);
  built_.options.rows = 1000000;  // all steps
  run_explicit_bonds(model_, built_.inertia, built_.rules, built_.options, order);
  const VtuGrid last = run.fields(run.series().size() - 1);
  const std::vector<double>& broken_at = last.find_cell_data("broken_at")->values;
  std::size_t next = 0;
  for (std::size_t cell = 0; cell < broken_at.size(); ++cell) {
    if (broken_at[cell] == 0.0) continue;
    ASSERT_LT(next, order.broken.size());
    const Index element = order.broken[next++];
    EXPECT_EQ(broken_at[cell], static_cast<double>(next));
    EXPECT_EQ(last.connectivity[last.offsets[cell] - 2], model_.network.bonds.first[element]);
    EXPECT_EQ(last.connectivity[last.offsets[cell] - 1], model_.network.bonds.second[element]);
  }
  EXPECT_EQ(next, order.broken.size());
  EXPECT_FALSE(std::is_sorted(order.broken.begin(), order.broken.end()));
}

/// The model may have used factors to calibrate bonds; steps and their preparation need none.
TEST_F(BondRunTest, TakesNoFactor) {
  const test::TemporaryDirectory work;
  const auto run = make_bond_run(input_, 1, true);
  const int before = factors_made();
  build_bond_run(input_, model_);
  run->open(work.path(), true);
  run->analyse();
  EXPECT_EQ(factors_made(), before);
}

/// Both halves fly apart for good: all that the load does is motion.
TEST_F(BondRunTest, DoubtsABodyThatFliesApart) {
  std::string text = replaced(pulled_block, "[[displacements]]", "[[loads]]");
  text = replaced(replaced(text, "y = 0.05", "force = [0, 4]"), "damping_rate = 0.5\n", "");
  const test::WholeRun run(replaced(text, "duration = 8", "duration = 16"));
  const auto& json = run.summary.json;
  EXPECT_GT(json["kinetic_energy"].get<double>(), 0.9 * json["external_work"].get<double>());
  EXPECT_THAT(run.summary.warnings,
              testing::Contains(testing::HasSubstr("a piece of the body is unsupported")));
  EXPECT_EQ(json["warnings"], run.summary.warnings);
  EXPECT_THAT(run.summary.text, testing::HasSubstr("unsupported"));
}

/// Springs hold a body as supports do, however far they give.
TEST_F(BondRunTest, ABodyOnSpringsIsHeld) {
  std::string text = replaced(pulled_block, "[[supports]]", "[[springs]]");
  text = replaced(replaced(text, "fix = [\"x\", \"y\"]", "total = [1, 1]"), "[[displacements]]",
                  "[[loads]]");
  text = replaced(replaced(text, "y = 0.05", "force = [0, 1e-4]"), "damping_rate = 0.5\n", "");
  const test::WholeRun run(
      replaced(replaced(text, "duration = 8", "duration = 2.5"), "[4]", "[1]"));
  EXPECT_EQ(run.summary.json["broken_bonds"], 0);
  const std::vector<std::string>& warnings = run.summary.warnings;
  EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("is kinetic energy at the end")));
  EXPECT_THAT(warnings, testing::Not(testing::Contains(testing::HasSubstr("unsupported"))));
}

TEST_F(BondRunTest, SummaryTellsHowItEnded) {
  const test::WholeRun run(input_);
  const auto& json = run.summary.json;
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["steps"], built_.options.steps());
  EXPECT_FALSE(json.contains("fundamental_period")) << "nothing asks for it";
  EXPECT_EQ(json["bonds"], model_.network.num_elements());
  EXPECT_LT(json["energy_error"], 1e-11) << "round-off of some hundred steps";
  EXPECT_THAT(run.summary.text, testing::HasSubstr("broken bonds"));
}

}  // namespace
}  // namespace perilink
