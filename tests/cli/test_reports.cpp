// perilink report from outside: messages, exit statuses, the page.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "app/report/report_assets.hpp"
#include "support/decompressed.hpp"
#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Reports : public testing::Test {
 protected:
  void SetUp() override {
    if (report_assets().dygraphs.empty()) GTEST_SKIP() << "built without dygraphs";
    fs::create_directories(work());
  }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  void make_result(const std::string& name, const std::string& title = "Small block") const {
    std::string text = small_ghost_case;
    text.replace(text.find("Small block"), 11, title);
    write_text(work() / (name + ".toml"), text);
    const ProcessEnd end = run({"run", name + ".toml", "--quiet"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  std::string file(const std::string& name) const { return read_text(work() / name); }
  /// The embedded data with a number, as a browser decompresses it.
  static std::string stream(const std::string& page, int number) {
    const std::string begin = "id=\"stream-" + std::to_string(number) + "\">";
    const std::size_t at = page.find(begin) + begin.size();
    return decompressed(std::string_view(page).substr(at, page.find('<', at) - at));
  }

  TemporaryDirectory temporary_;
};

TEST(ReportsWithoutTheLibrary, AreRefusedWithTheNameOfThePackage) {
  if (!report_assets().dygraphs.empty()) GTEST_SKIP() << "built with dygraphs";
  const TemporaryDirectory temporary;
  fs::create_directories(temporary / "work");
  const ProcessEnd end = run_program(temporary / "work", {"report", "."});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("Debian: libjs-dygraphs"));
}

TEST_F(Reports, ThePageHoldsTheNumbersAndNeedsNoNetwork) {
  make_result("a", "Block </script><img src=x> & 'so'");
  const ProcessEnd end = run({"report", "results/a"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(end.err, "");
  EXPECT_THAT(end.out, HasSubstr("results/a/report.html ("));
  const std::string page = file("results/a/report.html");
  // The case is the first stream, the history the second.
  EXPECT_EQ(stream(page, 0), file("results/a/case.toml"));
  EXPECT_EQ(stream(page, 1), file("results/a/history.csv"));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_FALSE(std::regex_search(page, std::regex(R"((src|href)\s*=\s*["']?(https?:)?//)")));
  EXPECT_THAT(page, Not(HasSubstr("http-equiv=\"refresh\"")));
}

TEST_F(Reports, SeveralRunsShareAPage) {
  make_result("a");
  make_result("b", "Other block");
  ASSERT_EQ(run({"report", "results/a", "results/b/"}).exit_status, 0);
  EXPECT_THAT(file("report.html"), HasSubstr("Other block"));
  ASSERT_EQ(run({"report", "results/a", "--out", "own.html"}).exit_status, 0);
  EXPECT_THAT(file("own.html"), Not(HasSubstr("Other block")));
}

TEST_F(Reports, OnlyReportsAreOverwritten) {
  make_result("a");
  ASSERT_EQ(run({"report", "results/a"}).exit_status, 0);
  EXPECT_EQ(run({"report", "results/a"}).exit_status, 0) << "a report may be made again";
  const std::string history = file("results/a/history.csv");
  const ProcessEnd end = run({"report", "results/a", "--out", "results/a/history.csv"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_THAT(end.err, HasSubstr("results/a/history.csv: exists and is not a report of perilink"));
  EXPECT_THAT(end.err, HasSubstr("--out FILE"));
  EXPECT_EQ(file("results/a/history.csv"), history);
  EXPECT_EQ(run({"run", "a.toml", "--quiet", "--force"}).exit_status, 0);
  EXPECT_FALSE(fs::exists(work() / "results/a/report.html")) << "a report of the earlier run";
}

TEST_F(Reports, ReportsOfUnfinishedRunsLoadAgain) {
  make_result("a");
  write_text(work() / "results/a/summary.json", R"({"status": "running"})");
  ASSERT_EQ(run({"report", "results/a"}).exit_status, 0);
  EXPECT_THAT(file("results/a/report.html"), HasSubstr("http-equiv=\"refresh\""));
  fs::remove(work() / "results/a/summary.json");
  EXPECT_EQ(run({"report", "results/a"}).exit_status, 0);
}

TEST_F(Reports, RunsAreWatchedUntilTheyEnd) {
  make_result("a");
  const std::string summary = file("results/a/summary.json");
  write_text(work() / "results/a/summary.json", R"({"status": "running"})");
  ProgramProcess watch(work(), {"report", "results/a", "--watch"});
  const fs::path page = work() / "results/a/report.html";
  ASSERT_TRUE(watch.wait_until([&] { return fs::exists(page); }));
  EXPECT_THAT(file("results/a/report.html"), HasSubstr("http-equiv=\"refresh\""));
  write_text(work() / "results/a/summary.json", summary);
  EXPECT_EQ(watch.wait().exit_status, 0);
  EXPECT_THAT(file("results/a/report.html"), Not(HasSubstr("http-equiv=\"refresh\"")));
}

TEST_F(Reports, OtherDirectoriesAreRefused) {
  fs::create_directories(work() / "empty");
  for (const char* place : {"empty", "nowhere"}) {
    const ProcessEnd end = run({"report", place});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, HasSubstr(place));
  }
  EXPECT_EQ(run({"report"}).exit_status, 2) << "no directory";
  make_result("a");
  const ProcessEnd end = run({"report", "results/a", "--out", "nowhere/page.html"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("nowhere/page.html"));
}

TEST_F(Reports, DamagedFieldsAreNamed) {
  make_result("a");
  write_text(work() / "results/a/fields_000011.vtu", "no fields");
  const ProcessEnd end = run({"report", "results/a"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("results/a/fields_000011.vtu: "));
  EXPECT_FALSE(fs::exists(work() / "results/a/report.html"));
}

}  // namespace
}  // namespace perilink::test
