#include "results/summary_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

TEST(SummaryFile, SaysFromTheStartThatTheRunGoesOn) {
  const test::TemporaryDirectory work;
  CaseFile input;
  input.title = "Beam";
  input.analysis.type = AnalysisType::elastic;
  input.body.model = BodyModel::micropolar;
  write_running_summary(work.path(), input, "");
  const auto summary = read_summary_file(work.path());
  ASSERT_TRUE(summary.has_value());
  EXPECT_EQ(summary_text(*summary, "title", work.path()), "Beam");
  EXPECT_EQ(summary_text(*summary, "status", work.path()), "running");
  EXPECT_EQ(summary_text(*summary, "analysis", work.path()), "elastic");
  EXPECT_EQ(summary_text(*summary, "model", work.path()), "micropolar");
  EXPECT_GE(std::filesystem::file_size(work / "summary.json"), 8192u) << "room for the last one";
}

TEST(SummaryFile, IsReplacedAtTheEnd) {
  const test::TemporaryDirectory work;
  write_running_summary(work.path(), {}, "");
  write_summary_file(work.path(), {{"status", "failed"}, {"reason", "no \xff UTF-8"}});
  const auto summary = read_summary_file(work.path());
  EXPECT_EQ(summary_text(*summary, "status", work.path()), "failed");
  EXPECT_EQ(summary_text(*summary, "reason", work.path()), "no \xef\xbf\xbd UTF-8");
  EXPECT_EQ(summary_text(*summary, "title", work.path()), "");
}

TEST(SummaryFile, MayBeMissing) {
  const test::TemporaryDirectory work;
  EXPECT_FALSE(read_summary_file(work.path()).has_value());
}

TEST(SummaryFile, DamagedOnesAreRefusedWithWhatToDo) {
  const test::TemporaryDirectory work;
  for (const std::string text :
       {"", " ", "{", "[1]", "null", "{\"a\": 1e400}", "{\"a\": nan}", "{\"a\": 1}}", "{}",
        "{\"status\": \"completed\", \"peak_load\": \"much\"}"}) {
    test::write_text(work / "summary.json", text);
    try {
      read_summary_file(work.path());
      ADD_FAILURE() << "accepted " << text;
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("summary.json: "));
      EXPECT_THAT(error.what(), HasSubstr("delete it"));
    }
  }
  test::write_text(work / "summary.json", "{\"status\": \"failed\", \"title\": 5}");
  EXPECT_THROW(summary_text(*read_summary_file(work.path()), "title", work.path()), FileError);
}

}  // namespace
}  // namespace perilink
