#include "app/scan/scan_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "support/temporary_directory.hpp"

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

TEST(ScanTable, NamesTheValuesOfAMember) {
  const test::TemporaryDirectory work;
  write_whole_file((work / "scan.csv").string(),
                   scan_table(parse_scan(three_runs, ""), three_results()));
  std::filesystem::create_directories(work / "0001");
  EXPECT_EQ(scanned_values(work / "0001"), "spacing = 2");
  EXPECT_EQ(scanned_values(work / "0002/"), "spacing = 1, title = b, c");
  EXPECT_EQ(scanned_values(work / "0009"), "");
  EXPECT_EQ(scanned_values(work.path()), "");
  const ScanFile alike =
      parse_scan("case = \"a.toml\"\n[values]\na.x = [1]\nb.x = [\"say \\\"so\\\"\"]\n", "");
  write_whole_file((work / "scan.csv").string(), scan_table(alike, std::vector<ScanResult>(1)));
  EXPECT_EQ(scanned_values(work / "0001"), "a.x = 1, b.x = say \"so\"");
}

/// Values 2, 4, 6: mean 4, deviation sqrt(8 / 2) = 2.
TEST(ScanTable, TellsMeanAndDeviationOverSeedsWithOtherValuesAlike) {
  ScanFile scan = parse_scan("case = \"a.toml\"\nseeds = 3\n[values]\na = [1, 2]\n", "");
  give_seeds(scan, parse_toml("[[random]]\n", ""));
  std::vector<ScanResult> results(6);
  for (std::size_t k = 0; k < 4; ++k) {
    results[k].numbers = {{"peak_load", 2.0 * static_cast<double>(k + 1)}};
  }
  const std::vector<ScanSample> samples = samples_of(scan, results, "peak_load");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[0].name, "a = 1");
  EXPECT_EQ(samples[0].mean(), 4.0);
  EXPECT_EQ(samples[0].deviation(), 2.0);
  const std::string text = scan_report(scan, results);
  EXPECT_THAT(text,
              HasSubstr("peak_load over a = 1, 3 seeds: mean 4, standard deviation 2 (50 %)"));
  EXPECT_THAT(text, HasSubstr("peak_load over a = 2, 1 seed: 8"));
  EXPECT_EQ(seed_table(scan, results),
            "set,quantity,seeds,mean,standard_deviation\n"
            "a = 1,peak_load,3,4,2\na = 2,peak_load,1,8,\n");
  EXPECT_THAT(scan_report(scan, std::vector<ScanResult>(6)), HasSubstr("no seed with a result"));
  EXPECT_TRUE(samples_of(parse_scan(three_runs, ""), three_results(), "peak_load").empty());
}

}  // namespace
}  // namespace perilink
