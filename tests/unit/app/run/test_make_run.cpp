#include "app/run/run_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_cases.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(MakeRun, ChoosesTheKindThatTheCaseAsksFor) {
  CaseFile input = test::strip_case();
  input.materials[0].density = 1.0;
  input.analysis.duration = 1.0;
  input.analysis.load_factors = {1.0};
  const auto plan = [&](AnalysisType type) {
    input.analysis.type = type;
    const auto run = make_run(input, 2, true);
    EXPECT_EQ(run->threads, 2);
    EXPECT_TRUE(run->calibration.has_value());
    EXPECT_THAT(run->plan, HasSubstr("45 particles, "));
    return run->plan;
  };
  EXPECT_THAT(plan(AnalysisType::damage), HasSubstr("60 unknowns"));
  EXPECT_THAT(plan(AnalysisType::elastic), HasSubstr("60 unknowns"));
  EXPECT_THAT(plan(AnalysisType::relaxation), HasSubstr("1 load step"));
  EXPECT_THAT(plan(AnalysisType::explicit_), HasSubstr("(critical "));
  const CaseFile lattice = parse_case(test::lattice_bar_case(), "");
  const auto run = make_run(lattice, 1, true);
  EXPECT_THAT(run->plan, HasSubstr("216 particles, "));
  EXPECT_FALSE(run->calibration.has_value());
}

}  // namespace
}  // namespace perilink
