#include "app/scan/scan_result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/strip_case.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

class ScanResults : public testing::Test {
 protected:
  ScanResults() { fs::create_directories(place()); }
  fs::path place() const { return directory_ / "0001"; }
  void write(const std::string& name, const std::string& text) const {
    test::write_text(place() / name, text);
  }
  void write_status(const std::string& status) const {
    write("summary.json", R"({"status": ")" + status + R"(", "reason": "why", "peak_load": 3,
        "peak_displacement": 0.1, "seconds": {"set_up": 1, "analysis": 2, "output": 0.5}})");
    write("history.csv", "step,load,displacement,mouth\n1,2,0.05,7\n2,3,0.1,8\n3,1,0.2,9\n");
  }

  test::TemporaryDirectory directory_;
};

TEST_F(ScanResults, HoldNumbersGaugesAtThePeakAndSeconds) {
  write_status("collapsed");
  const ScanResult result = read_scan_result(place());
  EXPECT_TRUE(result.finished());
  EXPECT_EQ(result.reason, "why");
  EXPECT_EQ(number_of(result.numbers, "peak_load"), 3.0);
  EXPECT_TRUE(std::isnan(number_of(result.numbers, "broken_bonds")));
  EXPECT_EQ(number_of(result.gauges, "mouth"), 8.0);
  EXPECT_EQ(result.seconds, 3.5);
}

TEST_F(ScanResults, OfUnfinishedRunsHaveNoNumbers) {
  EXPECT_EQ(read_scan_result(place()).status, "not run");
  write_status("interrupted");
  const ScanResult result = read_scan_result(place());
  EXPECT_FALSE(result.finished());
  EXPECT_TRUE(result.numbers.empty());
}

TEST_F(ScanResults, OfFailedProcessesTellTheReason) {
  write_status("completed");
  const auto reason = [&](const FinishedProcess& process) {
    const ScanResult result = result_of_process(process, place());
    EXPECT_EQ(result.status, "failed");
    return result.reason;
  };
  EXPECT_EQ(reason({0, 2, 0, "perilink: bad input: a.toml: is wrong\n  mend it\n"}),
            "a.toml: is wrong");
  EXPECT_EQ(reason({0, -1, 9, ""}), "ended by signal 9 (Killed)");
  EXPECT_EQ(reason({0, 3, 0, ""}), "ended with exit status 3");
  EXPECT_EQ(result_of_process({0, 0, 0, ""}, place()).status, "completed");
  write_status("interrupted");
  EXPECT_EQ(result_of_process({0, 4, 0, ""}, place()).status, "interrupted");
}

}  // namespace
}  // namespace perilink
