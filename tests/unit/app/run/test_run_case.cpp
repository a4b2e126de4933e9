#include "app/run/run_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "io/text/csv.hpp"
#include "results/summary_file.hpp"
#include "support/program_cases.hpp"
#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

class RunCase : public testing::Test {
 protected:
  std::size_t rows() const { return read_csv((work_ / "out/history.csv").string()).rows.size(); }
  std::string status() const { return read_summary_file(work_ / "out")->at("status"); }

  test::TemporaryDirectory work_;
  CaseFile input_ = test::strip_case();
  RunSettings settings_{1, OldResults::refused, true};
};

TEST_F(RunCase, CallsBackAtEveryRow) {
  std::vector<RowProgress> seen;
  int starts = 0;
  settings_.callbacks.on_row = [&](const RowProgress& row) { seen.push_back(row); };
  settings_.callbacks.on_start = [&] { ++starts; };
  const RunEnd end = run_case(input_, work_ / "out", settings_);
  EXPECT_EQ(end.termination, Termination::collapsed);
  EXPECT_EQ(end.summary.json["status"], "collapsed");
  EXPECT_FALSE(end.error);
  EXPECT_EQ(starts, 1);
  const CsvTable history = read_csv((work_ / "out/history.csv").string());
  ASSERT_EQ(seen.size(), history.rows.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_EQ(seen[k].row, static_cast<Index>(k) + 1);
    EXPECT_EQ(seen[k].load, history.rows[k][static_cast<std::size_t>(history.column("load"))]);
  }
}

TEST_F(RunCase, CallsBackAtEveryRowOfALattice) {
  input_ = parse_case(test::lattice_bar_case(), "");
  std::vector<double> times;
  settings_.callbacks.on_row = [&](const RowProgress& row) { times.push_back(row.time); };
  run_case(input_, work_ / "out", settings_);
  EXPECT_EQ(times.size(), rows());
  EXPECT_GT(times.back(), times.front());
}

TEST_F(RunCase, EndsOnRequestWithItsResults) {
  Index row = 0;
  settings_.callbacks.on_row = [&](const RowProgress& now) { row = now.row; };
  settings_.callbacks.stop_requested = [&] { return row >= 2; };
  const RunEnd end = run_case(input_, work_ / "out", settings_);
  EXPECT_EQ(end.termination, Termination::interrupted);
  EXPECT_EQ(status(), "interrupted");
  EXPECT_EQ(rows(), 2u);
}

TEST_F(RunCase, KeepsTheFailureOfItsCallbacks) {
  std::vector<std::string> faults;
  settings_.callbacks.on_row = [](const RowProgress&) { throw DiskFull("no room"); };
  settings_.callbacks.on_fault = [&](const std::string& text) { faults.push_back(text); };
  const RunEnd end = run_case(input_, work_ / "out", settings_);
  EXPECT_EQ(end.termination, Termination::failed);
  ASSERT_TRUE(end.error);
  EXPECT_THROW(std::rethrow_exception(end.error), DiskFull);
  EXPECT_THAT(faults, testing::ElementsAre("no room"));
  EXPECT_EQ(status(), "failed");
}

TEST_F(RunCase, RefusesResultsBeforeItBuilds) {
  run_case(input_, work_ / "out", settings_);
  bool calibrates = false;
  settings_.callbacks.on_calibration = [&](int, double) { calibrates = true; };
  EXPECT_THROW(run_case(input_, work_ / "out", settings_), FileError);
  EXPECT_FALSE(calibrates);
  settings_.old_results = OldResults::removed;
  EXPECT_EQ(run_case(input_, work_ / "out", settings_).termination, Termination::collapsed);
  EXPECT_TRUE(calibrates);
}

}  // namespace
}  // namespace perilink
