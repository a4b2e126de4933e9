#include "app/scan/scan_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perilink {
namespace {

using testing::HasSubstr;

const char* const three_runs =
    "case = \"a.toml\"\n[[runs]]\nbody.spacing = 2\n[[runs]]\nbody.spacing = 1\ntitle = \"b, c\"\n"
    "[[runs]]\nbody.spacing = 4\n";

std::vector<ScanResult> three_results() {
  std::vector<ScanResult> results(3);
  results[0] = {"completed",       "done", {{"peak_load", 3.5}, {"broken_bonds", 7}},
                {{"mouth", 0.25}}, 1.5,    true};
  results[1].status = "failed";
  results[1].reason = "no memory\n  buy some";
  return results;
}

TEST(ScanTable, HasARowForEveryMember) {
  EXPECT_EQ(scan_table(parse_scan(three_runs, ""), three_results()),
            "member,body.spacing,title,status,peak_load,peak_displacement,first_peak_load,"
            "first_peak_displacement,smoothed_peak_load,initial_stiffness,external_work,"
            "dissipated_energy,strain_energy,broken_bonds,mouth_at_peak,reason,seconds\n"
            "0001,2,,completed,3.5,,,,,,,,,7,0.25,done,1.5\n"
            "0002,1,\"b, c\",failed,,,,,,,,,,,,\"no memory\n  buy some\",\n"
            "0003,4,,not run,,,,,,,,,,,,,\n");
}

TEST(ScanTable, IsPrintedWithReasonsAndASummary) {
  const std::string text = scan_report(parse_scan(three_runs, ""), three_results());
  for (const char* part :
       {"member  body.spacing  title", "0001             2      -  completed        3.5",
        "0002: no memory\n3 members: 1 completed, 1 failed, 1 not run (1 kept from an earlier "
        "scan)",
        "peak_load 3.5 to 3.5; 1.5 s of runs"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

}  // namespace
}  // namespace perilink
