#include "app/run/relaxation_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
