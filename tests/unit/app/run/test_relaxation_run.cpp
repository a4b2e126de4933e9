#include "app/run/relaxation_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/run/bond_run.hpp"
#include "support/strip_case.hpp"
#include "support/whole_run.hpp"

namespace perilink {
namespace {

class RelaxationRun : public testing::Test {
 protected:
  RelaxationRun() : input_(test::strip_case()) {
    input_.analysis.type = AnalysisType::relaxation;
    input_.analysis.load_factors = {0.5, 1.0};
    input_.analysis.tolerance = 1e-7;
    for (MaterialSection& material : input_.materials) material.fracture_energy = INFINITY;
  }

  CaseFile input_;
};

TEST_F(RelaxationRun, OptionsAreThoseOfTheCase) {
  input_.analysis.strain = Strain::green;
  input_.analysis.iterations = 77;
  const RelaxationOptions options = relaxation_options(input_, 3);
  EXPECT_EQ(options.load_factors, (std::vector{0.5, 1.0}));
  EXPECT_EQ(options.tolerance, 1e-7);
  EXPECT_EQ(options.most_iterations, 77);
  EXPECT_EQ(options.strain, Strain::green);
  EXPECT_EQ(options.threads, 3);
}

/// A block turned by 30 degrees: at the end loads, reactions and residual are round-off.
const char* const turned_block = R"(regions = [
  {name = "block", x = [0, 100], y = [0, 50]},
  {name = "left", x = [0, 0], y = [0, 50]},
  {name = "right", x = [100, 100], y = [0, 50]},
]
[body]
spacing = 5
horizon_ratio = 3
[[materials]]
region = "block"
youngs_modulus = 30000
fracture_energy = "infinite"
density = 2.4e-9
[[displacements]]
region = "left"
x = "-0.1339745962155613 * x - 0.49999999999999994 * y"
y = "0.49999999999999994 * x - 0.1339745962155613 * y"
[[displacements]]
region = "right"
x = "-0.1339745962155613 * x - 0.49999999999999994 * y"
y = "0.49999999999999994 * x - 0.1339745962155613 * y"
[analysis]
type = "relaxation"
iterations = 20000
)";

TEST(RelaxationOfATurnedBlock, EndsWhereOnlyRoundOffIsLeft) {
  CaseFile input = parse_case(turned_block, "");
  input.analysis.strain = Strain::green;
  input.analysis.load_factors.clear();
  for (int k = 1; k <= 40; ++k) input.analysis.load_factors.push_back(0.025 * k);
  const test::WholeRun run(input);
  EXPECT_EQ(run.summary.json["status"], "completed") << run.summary.text;
  EXPECT_LE(run.summary.json["residual"].get<double>(), 1e-6);
  const std::vector<double> loads = run.history("load");
  EXPECT_LT(std::abs(loads.back()), 1e-8 * *std::ranges::max_element(loads));
}

TEST(RelaxationOfATurnedBlock, WarnsOfSmallStrains) {
  const test::WholeRun run(parse_case(turned_block, ""));
  EXPECT_THAT(run.summary.warnings,
              testing::Contains(testing::HasSubstr("the theory assumes small displacements")));
}

TEST_F(RelaxationRun, WritesARowAndFieldsForEachLoadStep) {
  const test::WholeRun run(input_);
  const CsvTable table = run.history();
  ASSERT_EQ(table.rows.size(), 2U);
  const int load = table.column("load"), time = table.column("time");
  EXPECT_DOUBLE_EQ(table.rows[1][load], 2.0 * table.rows[0][load]);
  EXPECT_EQ(table.rows[1][time], 2.0);
  EXPECT_EQ(run.series().size(), 2U);
  // The reaction carries the load, to the tolerance.
  const double last = std::abs(table.rows[1][load]);
  EXPECT_NEAR(std::abs(run.summary.json["peak_reaction"].get<double>()), last, 1e-6 * last);
}

TEST_F(RelaxationRun, EndsAtTheValueOfAGauge) {
  GaugeSection hold;
  hold.name = "hold";
  hold.reaction = "lower end";
  hold.axis = 1;
  input_.gauges = {hold};
  input_.stop.gauge = "hold";
  input_.stop.below = -0.1;
  const test::WholeRun run(input_);
  ASSERT_EQ(run.history("hold").size(), 1U);
  EXPECT_NEAR(run.history("hold")[0], -6.0, 1e-5);
  EXPECT_EQ(run.summary.json["status"], "completed");
}

TEST_F(RelaxationRun, SummaryTellsHowItEnded) {
  const test::WholeRun run(input_);
  EXPECT_THAT(run.summary.warnings, testing::IsEmpty());
  const auto& json = run.summary.json;
  EXPECT_EQ(json["status"], "completed") << json["reason"];
  EXPECT_GT(json["iterations"], 0);
  EXPECT_LE(json["residual"], 1e-7);
  EXPECT_LE(json["displacement_error"], 1e-7);
  EXPECT_EQ(json["rows"], 2);
  EXPECT_EQ(json["kinetic_energy"], 0.0) << "in equilibrium";
  EXPECT_THAT(run.summary.text, testing::HasSubstr("residual"));
}

}  // namespace
}  // namespace perilink
