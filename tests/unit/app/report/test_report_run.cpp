#include "app/report/report_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/decompressed.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string history = "step,load,displacement,cmod\n1,3,0.1,0\n2,5,0.3,0.25\n";

class ReportRuns : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    test::write_text(temporary_.path() / name, text);
  }
  nlohmann::ordered_json run() {
    streams_ = {};
    return report_run(temporary_.path().string(), 1000000, streams_);
  }
  std::string stream(const nlohmann::ordered_json& number) const {
    return test::decompressed(streams_.texts().at(number.get<std::size_t>()));
  }

  test::TemporaryDirectory temporary_;
  ReportStreams streams_;
};

TEST_F(ReportRuns, RowsAreTheBytesOfTheHistory) {
  write("history.csv", history);
  write("summary.json", R"({"status": "completed", "units": "N, mm", "title": "<b>Beam</b>"})");
  write("case.toml",
        "[body]\nspacing = 2\n[[cracks]]\npoints = [[0, 1], [2, 3]]\n"
        "[[gauges]]\nname = \"cmod\"\n");
  const auto json = run();
  EXPECT_EQ(stream(json["rows"]["stream"]), history);
  EXPECT_EQ(json["rows"]["columns"][1]["unit"], "N");
  EXPECT_EQ(json["rows"]["columns"][3]["is_gauge"], true);
  EXPECT_EQ(json["rows"]["columns"][3]["unit"], "mm");
  EXPECT_EQ(json["rows"]["peak"], (nlohmann::ordered_json{0.3, 5.0}));
  EXPECT_EQ(json["title"], "<b>Beam</b>") << "the page escapes it";
  EXPECT_EQ(json["is_running"], false);
  EXPECT_EQ(json["cracks"], nlohmann::ordered_json::parse("[[[0, 1], [2, 3]]]"));
  EXPECT_THAT(stream(json["case"]), HasSubstr("spacing = 2"));
  EXPECT_TRUE(json["body"].is_null());
}

TEST_F(ReportRuns, UnfinishedRunsAreShownWithANote) {
  write("history.csv", history + "3,4,");
  write("summary.json", R"({"status": "running"})");
  const auto json = run();
  EXPECT_EQ(json["is_running"], true);
  EXPECT_EQ(stream(json["rows"]["stream"]), history);
  EXPECT_THAT(json["notes"].dump(), HasSubstr("the run is not finished"));
  EXPECT_THAT(json["notes"].dump(), HasSubstr("history.csv ends within a row"));
  write("history.csv", "step,load,displacement\n");
  EXPECT_THAT(run()["notes"].dump(), HasSubstr("history.csv has no row yet"));
}

TEST_F(ReportRuns, ACaseThatCannotBeReadIsANote) {
  write("history.csv", history);
  EXPECT_THAT(run()["notes"].dump(), HasSubstr("case.toml is missing"));
  write("case.toml", "[body\n");
  EXPECT_THAT(run()["notes"].dump(), HasSubstr("the case cannot be read"));
}

TEST_F(ReportRuns, OtherDirectoriesAreRefused) {
  EXPECT_THROW(run(), FileError);
  write("history.csv", "step,load\n1,2\n");
  EXPECT_THROW(run(), FileError) << "no displacement";
}

}  // namespace
}  // namespace perilink
