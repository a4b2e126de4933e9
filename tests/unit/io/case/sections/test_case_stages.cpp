#include "io/case/sections/case_stages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/case_texts.hpp"

// The refusals themselves are data: tests/cli/malformed. Here stands what stages must let pass.

namespace perilink {
namespace {

using testing::HasSubstr;

const std::string push_and_back = std::string(small_case) + R"([[stages]]
name = "push"
load_fraction = 0.5

[[stages]]
name = "back"
loads = "push"
to = -0.5
)";

TEST(CaseStages, GiveLoadsOfOneStageTheirStage) {
  const CaseFile input = parse_case(push_and_back, "case.toml");
  EXPECT_EQ(input.loads[0].stage, "push");
  ASSERT_EQ(input.stages.size(), 2u);
  EXPECT_EQ(input.stages[0].loads, "push");
  EXPECT_EQ(input.stages[0].stop.load_fraction, 0.5);
  EXPECT_FALSE(input.stages[0].to);
  EXPECT_EQ(input.stages[1].loads, "push");
  EXPECT_EQ(input.stages[1].to, -0.5);
}

TEST(CaseStages, AreWrittenAndReadBack) {
  const std::string again = write_case(parse_case(push_and_back, "case.toml"));
  EXPECT_THAT(again, HasSubstr("stage = \"push\""));
  EXPECT_THAT(again, HasSubstr("to = -0.5"));
  EXPECT_EQ(write_case(parse_case(again, "case.toml")), again);
}

TEST(CaseStages, EndAtALoad) {
  const std::string text = replaced(push_and_back, "to = -0.5\n", "to_load = -12.5\n");
  const CaseFile input = parse_case(text, "case.toml");
  EXPECT_FALSE(input.stages[1].to);
  EXPECT_EQ(input.stages[1].to_load, -12.5);
  EXPECT_THAT(write_case(input), HasSubstr("to_load = -12.5"));
}

TEST(CaseStages, LetALastStageGoOnUntilCollapse) {
  EXPECT_EQ(message_of(replaced(push_and_back, "to = -0.5\n", "")), "accepted");
}

TEST(CaseStages, LeaveCasesWithoutThemAsTheyAre) {
  const std::string text = write_case(parse_case(small_case, "case.toml"));
  EXPECT_EQ(text.find("stage"), std::string::npos);
  EXPECT_NE(text.find("[stop]"), std::string::npos);
}

}  // namespace
}  // namespace perilink
