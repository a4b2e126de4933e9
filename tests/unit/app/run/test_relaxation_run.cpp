#include "app/run/relaxation_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/fields/vtu.hpp"
#include "io/text/csv.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

class RelaxationRun : public testing::Test {
 protected:
  RelaxationRun() : input_(test::strip_case()) {
    input_.analysis.type = AnalysisType::relaxation;
    input_.analysis.load_factors = {0.5, 1.0};
    input_.analysis.tolerance = 1e-7;
    for (MaterialSection& material : input_.materials) material.fracture_energy = INFINITY;
    model_ = build_model(input_);
  }

  RelaxationResult run(BondRunFiles& files) {
    RelaxationResult result = run_dynamic_relaxation(model_, relaxation_options(input_, 1), files);
    files.finish();
    return result;
  }

  test::TemporaryDirectory work_;
  CaseFile input_;
  Model model_;
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
  BondRunFiles files(input_, model_, 2, work_.path(), true);
  const RelaxationResult result = run(files);
  ASSERT_EQ(result.ending, Ending::completed) << result.reason;
  const CsvTable table = read_csv((work_ / "history.csv").string());
  ASSERT_EQ(table.rows.size(), 2U);
  const int load = table.column("load"), time = table.column("time");
  EXPECT_DOUBLE_EQ(table.rows[1][load], 2.0 * table.rows[0][load]);
  EXPECT_EQ(table.rows[1][time], 2.0);
  EXPECT_EQ(read_pvd((work_ / "fields.pvd").string()).size(), 2U);
  // The reaction bears the load, to the tolerance.
  EXPECT_NEAR(std::abs(result.peak_load), std::abs(result.last.load),
              1e-6 * std::abs(result.last.load));
}

/// What is expected is the decay of the slowest vibration, of the strip in bending; pulling it does
/// not excite that.
TEST_F(RelaxationRun, TakesAboutAsLongAsExpected) {
  BondRunFiles files(input_, model_, 2, work_.path(), true);
  const double taken = run(files).iterations;
  const double expected = expected_iterations(model_, relaxation_options(input_, 1));
  EXPECT_GT(taken, 0.2 * expected);
  EXPECT_LT(taken, 1.5 * expected);
}

TEST_F(RelaxationRun, SummaryTellsHowItEnded) {
  BondRunFiles files(input_, model_, 2, work_.path(), true);
  const RelaxationResult result = run(files);
  write_summary(work_.path(), input_, model_, result, files, {}, 2);
  std::ifstream file(work_ / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["iterations"], result.iterations);
  EXPECT_LE(json["residual"], 1e-7);
  EXPECT_LE(json["displacement_error"], 1e-7);
  EXPECT_EQ(json["rows"], 2);
  testing::internal::CaptureStdout();
  print_summary(work_.path(), input_, model_, result, files, {});
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("residual"));
}

}  // namespace
}  // namespace perilink
