// perilink scan from outside: tables, refusals, and scans that are killed and go on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <sstream>
#include <thread>

#include "app/report/report_assets.hpp"
#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The larger energies are four times the smaller ones, so the loads are twice as large.
constexpr const char* grid_scan = R"(case = "block.toml"
[values]
"materials[1].fracture_energy" = [0.001, 0.004]
"stop.broken_bonds" = [10, 20]
)";

class Scan : public testing::Test {
 protected:
  Scan() {
    fs::create_directories(work());
    write_text(work() / "block.toml", small_ghost_case);
  }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd scan(const std::string& text, std::vector<std::string> options = {}) const {
    write_text(work() / "scan.toml", text);
    options.insert(options.begin(), {"scan", "scan.toml"});
    return run_program(work(), options);
  }
  std::string file(const std::string& name) const { return read_text(work() / name); }

  /// The table without its last column, the seconds.
  std::string results(const std::string& directory) const {
    std::istringstream lines(file(directory + "/scan.csv"));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      text += line.substr(0, line.rfind(',')) + "\n";
    }
    return text;
  }
  /// A number of the table; column 4 is that of the peak loads behind two keys.
  double number(const std::string& directory, std::size_t row, std::size_t column) const {
    std::istringstream lines(file(directory + "/scan.csv"));
    std::string line, field;
    for (std::size_t k = 0; k <= row; ++k) std::getline(lines, line);
    std::istringstream fields(line);
    for (std::size_t k = 0; k <= column; ++k) std::getline(fields, field, ',');
    return std::stod(field);
  }

  TemporaryDirectory temporary_;
};

TEST_F(Scan, RunsEveryMemberAsRunWouldWithItsValues) {
  const ProcessEnd end = scan(grid_scan);
  ASSERT_EQ(end.exit_status, 0) << end.err;
  for (const char* part : {"Small block", "materials[1].fracture_energy", "4 members: 4 completed",
                           "results in results/scan"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  EXPECT_THAT(end.err, HasSubstr("[4/4] 000"));
  EXPECT_THAT(file("results/scan/scan.svg"), HasSubstr("stop.broken_bonds = 20"));
  // Loads of a brittle body of one material are proportional to the root of its fracture energy.
  EXPECT_NEAR(number("results/scan", 3, 4) / number("results/scan", 1, 4), 2.0, 1e-9);
  EXPECT_EQ(number("results/scan", 1, 13), 10.0) << "broken bonds";
  const ProcessEnd single =
      run_program(work(), {"run", "block.toml", "--set", "materials[1].fracture_energy=0.004",
                           "--set", "stop.broken_bonds=10", "--out", "single"});
  ASSERT_EQ(single.exit_status, 0);
  for (const char* name : {"/history.csv", "/case.toml"}) {
    EXPECT_EQ(file(std::string("results/scan/0003") + name), file(std::string("single") + name));
  }
  EXPECT_FALSE(fs::exists(work() / "results/scan/.calibrations")) << "needed by members only";
}

TEST_F(Scan, SetIsForEveryMember) {
  const std::string energies = replaced(grid_scan, "\"stop.broken_bonds\" = [10, 20]\n", "");
  ASSERT_EQ(scan(energies, {"--set", "stop.broken_bonds=15"}).exit_status, 0);
  EXPECT_EQ(number("results/scan", 1, 12), 15.0);
  EXPECT_EQ(number("results/scan", 2, 12), 15.0);
  ProcessEnd end = scan(grid_scan, {"--set", "stop.broken_bonds=15", "--force"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("--set stop.broken_bonds: has other values in the scan"));
  end = scan(energies, {"--set", "stop.broken_bonds=-1", "--force"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, AllOf(HasSubstr("--set"), HasSubstr("stop.broken_bonds"),
                             Not(HasSubstr("refuses member"))));
}

TEST_F(Scan, ReportsNameTheValues) {
  ASSERT_EQ(scan(grid_scan, {"--quiet"}).exit_status, 0);
  const ProcessEnd end = run_program(work(), {"report", "results/scan/0001", "results/scan/0004"});
  if (report_assets().dygraphs.empty()) GTEST_SKIP() << "built without dygraphs";
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(file("report.html"), AllOf(HasSubstr("fracture_energy = 0.001, broken_bonds = 10"),
                                         HasSubstr("fracture_energy = 0.004, broken_bonds = 20")));
}

TEST_F(Scan, ResultsDoNotDependOnJobs) {
  ASSERT_EQ(scan(grid_scan, {"--out", "one", "--jobs", "1", "--quiet"}).exit_status, 0);
  const ProcessEnd end = scan(grid_scan, {"--out", "many", "--jobs", "4", "--quiet"});
  ASSERT_EQ(end.exit_status, 0);
  EXPECT_EQ(end.out + end.err, "");
  EXPECT_EQ(results("one"), results("many"));
  EXPECT_EQ(file("one/scan.svg"), file("many/scan.svg"));
}

/// Fields of a generator are members like any values. A member whose file has changed runs again.
TEST_F(Scan, TakesAFileOfAFieldPerMember) {
  write_text(work() / "block.toml",
             std::string(small_ghost_case) +
                 "[[graded]]\nproperty = \"fracture_energy\"\nfile = \"one.csv\"\n");
  write_text(work() / "one.csv", "x,y,factor\n0,0,1\n0,200,1\n");
  write_text(work() / "four.csv", "x,y,factor\n0,0,4\n0,200,4\n");
  const std::string text =
      "case = \"block.toml\"\n[values]\n\"graded[1].file\" = [\"one.csv\", \"four.csv\"]\n";
  const ProcessEnd end = scan(text);
  ASSERT_EQ(end.exit_status, 0) << end.err;
  // Loads of a brittle body are proportional to the root of its fracture energy.
  EXPECT_NEAR(number("results/scan", 2, 3) / number("results/scan", 1, 3), 2.0, 1e-9);
  EXPECT_THAT(scan(text).out, HasSubstr("kept"));
  write_text(work() / "four.csv", "x,y,factor\n0,0,9\n0,200,9\n");
  EXPECT_THAT(scan(text).err, HasSubstr("0002: holds the results of another case"));
}

TEST_F(Scan, FinishedMembersAreKept) {
  ASSERT_EQ(scan(grid_scan).exit_status, 0);
  const std::string table = file("results/scan/scan.csv"), log = file("results/scan/0002/log.txt");
  ProcessEnd end = scan(grid_scan);
  EXPECT_EQ(end.exit_status, 0);
  EXPECT_THAT(end.out, HasSubstr("4 completed (4 kept from an earlier scan)"));
  EXPECT_EQ(file("results/scan/scan.csv"), table);

  // A run that was killed runs again, others do not.
  write_text(work() / "results/scan/0001/summary.json", "{\"status\": \"running\"}");
  end = scan(grid_scan);
  EXPECT_THAT(end.out, HasSubstr("4 completed (3 kept from an earlier scan)"));
  EXPECT_EQ(file("results/scan/0002/log.txt"), log);

  // Results of another case are overwritten on request only.
  const std::string other = replaced(grid_scan, "[10, 20]", "[10, 15]");
  end = scan(other);
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, AllOf(HasSubstr("results/scan/0002: its rows may be past stop.broken_bonds"),
                             HasSubstr("--force")));
  EXPECT_EQ(file("results/scan/0002/log.txt"), log);
  EXPECT_EQ(scan(other, {"--force"}).exit_status, 0);
  EXPECT_EQ(number("results/scan", 2, 13), 15.0);
}

TEST_F(Scan, AFailedMemberIsARowWithItsReason) {
  const std::string text =
      "case = \"block.toml\"\n[[runs]]\nbody.spacing = 1e-7\n[[runs]]\nstop.broken_bonds = 5\n";
  const ProcessEnd end = scan(text);
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.out, AllOf(HasSubstr("--set body.spacing: gives about"),
                             HasSubstr("2 members: 1 completed, 1 failed")));
  EXPECT_THAT(file("results/scan/scan.csv"), HasSubstr("0001,1e-07,,failed,"));
  EXPECT_THAT(file("results/scan/scan.csv"), HasSubstr("0002,,5,completed,"));
}

TEST_F(Scan, WrongScansAreRefusedBeforeAnythingRuns) {
  struct Bad {
    std::string text, says, remedy;
  };
  const std::string head = "case = \"block.toml\"\n[values]\n";
  for (const Bad& bad :
       {Bad{"case = \"nowhere.toml\"\n[values]\na = [1]\n", "nowhere.toml", ""},
        Bad{head + "stop.broken_bonds = [10, -1]\n",
            "scan.toml:3: the case refuses member 0002 (stop.broken_bonds = -1)",
            "--set stop.broken_bonds: is the integer -1, but must be an integer from"},
        Bad{head + "body.spacng = [1, 2]\n", "scan.toml:3", "did you mean `spacing`?"},
        Bad{head + "\"materials[3].fracture_energy\" = [1]\n", "scan.toml:3",
            "the list has 2 entries"},
        Bad{head + "body.spacing = [12.5, 6.25\n", "scan.toml:", "is not valid TOML"},
        Bad{small_ghost_case, "belongs to a case", "perilink run scan.toml"}}) {
    const ProcessEnd end = scan(bad.text);
    EXPECT_EQ(end.exit_status, 2) << bad.text;
    EXPECT_THAT(end.err, AllOf(HasSubstr(bad.says), HasSubstr(bad.remedy)));
    EXPECT_FALSE(fs::exists(work() / "results")) << bad.text;
  }
  write_text(work() / "scan.toml", grid_scan);
  EXPECT_THAT(run_program(work(), {"run", "scan.toml"}).err, HasSubstr("perilink scan scan.toml"));
}

TEST_F(Scan, DirectoriesOfRunsAreRefused) {
  ASSERT_EQ(run_program(work(), {"run", "block.toml", "--out", "results/scan"}).exit_status, 0);
  const ProcessEnd end = scan(grid_scan);
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("results/scan: holds the results of an earlier run"));
}

constexpr const char* longer_scan = R"(case = "block.toml"
[values]
"materials[1].fracture_energy" = [0.001, 0.002, 0.003]
"stop.broken_bonds" = [20, 30]
)";

TEST_F(Scan, StopsOnRequestAndGoesOn) {
  ASSERT_EQ(scan(longer_scan, {"--out", "whole", "--quiet"}).exit_status, 0);
  ProgramProcess process(work(), {"scan", "scan.toml", "--out", "r", "--jobs", "1"});
  ASSERT_TRUE(process.wait_until([&] { return fs::exists(work() / "r/0002/case.toml"); }));
  process.send(SIGINT);
  const ProcessEnd stopped = process.wait();
  EXPECT_EQ(stopped.exit_status, 4) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("interrupted; the results so far are kept"));
  EXPECT_THAT(file("r/scan.csv"), HasSubstr("not run"));
  const ProcessEnd end = scan(longer_scan, {"--out", "r"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("kept from an earlier scan"));
  EXPECT_EQ(results("r"), results("whole"));
}

TEST_F(Scan, KilledAtAnyMomentItGoesOnToTheSameTable) {
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(scan(longer_scan, {"--out", "whole", "--quiet"}).exit_status, 0);
  const std::chrono::duration<double> length = std::chrono::steady_clock::now() - start;
  std::mt19937 random(20261130);
  std::uniform_real_distribution<double> moment(0.0, 0.4 * length.count());
  int killed = 0;
  for (int k = 0; k < 8; ++k) {
    fs::remove_all(work() / "r");
    for (int kills = 0; kills < 3; ++kills) {
      ProgramProcess process(work(), {"scan", "scan.toml", "--out", "r", "--quiet"});
      std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
      process.send(SIGKILL);
      killed += process.wait().signal == SIGKILL ? 1 : 0;
    }
    const ProcessEnd end = scan(longer_scan, {"--out", "r", "--quiet"});
    ASSERT_EQ(end.exit_status, 0) << end.err << file("r/scan.csv");
    ASSERT_EQ(results("r"), results("whole"));
    for (const char* name : {"0001", "0006"}) {
      ASSERT_EQ(file(fmt::format("r/{}/history.csv", name)),
                file(fmt::format("whole/{}/history.csv", name)));
    }
  }
  EXPECT_GT(killed, 6) << "the moments lie within the scan";
}

TEST_F(Scan, RunsSamplesOfARandomCaseAlikeWithAnyNumberOfThreads) {
  write_text(work() / "block.toml",
             replaced(small_ghost_case, "[analysis]",
                      "[[random]]\nproperty = \"fracture_energy\"\ndistribution = \"weibull\"\n"
                      "variation = 0.2\ncorrelation_length = 40\n\n[analysis]"));
  const std::string samples = "case = \"block.toml\"\nseeds = 3\n";
  const ProcessEnd end = scan(samples);
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("peak_load over 3 seeds: mean "));
  EXPECT_NE(number("results/scan", 1, 3), number("results/scan", 2, 3)) << "another seed";
  EXPECT_THAT(file("results/scan/scan.svg"), HasSubstr("3 seeds: mean "));
  EXPECT_THAT(file("results/scan/scan_seeds.csv"),
              HasSubstr("set,quantity,seeds,mean,standard_deviation\n,peak_load,3,"));
  ASSERT_EQ(scan(samples, {"--out", "again", "--threads", "2"}).exit_status, 0);
  EXPECT_EQ(results("again"), results("results/scan"));
  EXPECT_EQ(file("again/0002/history.csv"), file("results/scan/0002/history.csv"));
}

TEST_F(Scan, RefusesSeedsOfACaseWithoutRandomTables) {
  const ProcessEnd end = scan("case = \"block.toml\"\nseeds = 3\n");
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, AllOf(HasSubstr("scan.toml:2"), HasSubstr("has no [[random]]")));
}

}  // namespace
}  // namespace perilink::test
