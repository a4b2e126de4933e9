// perilink converge from outside: messages, exit statuses, files, errors of a small bar.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string vary = R"(case = "bar.toml"

[vary]
spacing = [0.25, 0.125, 0.0625]
horizon_ratio = [2]
surface = ["none", "ghost"]
)";

const std::string energy = "\n[error]\nquantity = \"strain_energy\"\nreference = 0.04\n";

class Study : public testing::Test {
 protected:
  Study() {
    fs::create_directories(work());
    write_text(work() / "bar.toml", tension_strip_case);
  }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd converge(const std::string& text, std::vector<std::string> options = {}) const {
    write_text(work() / "study.toml", text);
    options.insert(options.begin(), {"converge", "study.toml"});
    return run_program(work(), options);
  }
  std::string file(const std::string& name) const { return read_text(work() / name); }
  std::set<std::string> names(const std::string& directory) const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(work() / directory)) {
      found.insert(entry.path().filename().string());
    }
    return found;
  }

  TemporaryDirectory temporary_;
};

/// Fields of the rows of a table; a comma between quotes splits too.
std::vector<std::vector<std::string>> rows(const std::string& table) {
  std::vector<std::vector<std::string>> result;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    result.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) result.back().push_back(field);
  }
  return result;
}

TEST_F(Study, WritesTheFilesOfTheContractAndNoOthers) {
  const ProcessEnd end = converge(vary + energy);
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(names("results/study"),
            (std::set<std::string>{"study.toml", "table.csv", "timing.csv", "error_unknowns.svg",
                                   "error_seconds.svg"}));
  for (const char* part : {"none", "ghost", "error of strain_energy", "order",
                           "reference of strain_energy: 0.04, as given", "results/study"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  EXPECT_THAT(end.err, HasSubstr("[6/6] ghost, horizon ratio 2, spacing 0.0625"));
  EXPECT_THAT(file("results/study/error_unknowns.svg"), HasSubstr("none, horizon ratio 2: order"));
}

TEST_F(Study, TheErrorOfAnUncorrectedBarFalls) {
  ASSERT_EQ(converge(vary + "\n[error]\ndisplacement = [\"0.02*x\", \"-0.02/3*y\"]\n").exit_status,
            0);
  const auto table = rows(file("results/study/table.csv"));
  ASSERT_EQ(table.size(), 7u);
  // The name of the series holds a comma, which shifts the fields of the rows by one.
  EXPECT_EQ(table[0][9], "displacement_error");
  EXPECT_EQ(table[1][2], "0.25");
  for (int row = 2; row <= 3; ++row) {
    const double coarse = std::stod(table[row - 1][10]);
    const double fine = std::stod(table[row][10]);
    EXPECT_LT(fine, coarse);
    EXPECT_NEAR(std::stod(table[row][11]), std::log2(coarse / fine), 1e-12);
  }
}

TEST_F(Study, LinearElementsSolveTheStripToRoundOff) {
  ASSERT_EQ(converge("case = \"bar.toml\"\n[vary]\nspacing = [0.25, 0.125]\n"
                     "method = [\"bonds\", \"linear_elements\"]\n"
                     "[error]\ndisplacement = [\"0.02*x\", \"-0.02/3*y\"]\n")
                .exit_status,
            0);
  const auto table = rows(file("results/study/table.csv"));
  ASSERT_EQ(table.size(), 5u);
  for (int row = 3; row <= 4; ++row) {
    EXPECT_EQ(table[row][2], "linear_elements");
    EXPECT_LT(std::stod(table[row][9]), 1e-12);  // condition numbers near 1e3
  }
  EXPECT_GT(std::stod(table[2][9]), 1e-3) << "bonds without correction are too soft";
}

TEST_F(Study, TheTableDependsNeitherOnThreadsNorOnTheClock) {
  ASSERT_EQ(converge(vary + energy, {"--out", "one", "--threads", "1", "--quiet"}).exit_status, 0);
  ASSERT_EQ(converge(vary + energy, {"--out", "two", "--threads", "2", "--quiet"}).exit_status, 0);
  for (const char* name : {"table.csv", "study.toml", "error_unknowns.svg"}) {
    EXPECT_EQ(file(std::string("one/") + name), file(std::string("two/") + name)) << name;
  }
}

TEST_F(Study, TheWrittenStudyRunsAgainToTheSameTable) {
  ASSERT_EQ(converge(vary + energy, {"--out", "first", "--quiet"}).exit_status, 0);
  const ProcessEnd end =
      run_program(work(), {"converge", "first/study.toml", "--out", "second", "--quiet"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(end.out + end.err, "");
  EXPECT_EQ(file("first/table.csv"), file("second/table.csv"));
}

/// A weak part of a body breaks, and a strong part carries more afterwards.
TEST_F(Study, APeakAfterCollapseIsTold) {
  write_text(work() / "parts.toml", R"(
regions = [
  {name = "weak", x = [0, 40], y = [0, 40]},
  {name = "strong", x = [50, 60], y = [0, 40]},
  {name = "lower end", x = [0, 60], y = [0, 5]},
  {name = "upper end", x = [0, 60], y = [35, 40]},
]
[body]
spacing = 10
horizon_ratio = 1.5
[[materials]]
name = "weak"
region = "weak"
youngs_modulus = 1000
fracture_energy = 1e-3
[[materials]]
name = "strong"
region = "strong"
youngs_modulus = 1000
fracture_energy = 10
[[supports]]
region = "lower end"
fix = ["x", "y"]
[[displacements]]
region = "upper end"
x = 0
y = 1
)");
  const ProcessEnd end = converge(
      "case = \"parts.toml\"\n[vary]\nspacing = [10, 5]\n"
      "[[error]]\nquantity = \"peak_load\"\nreference = \"finest\"\n"
      "[[error]]\nquantity = \"first_peak_load\"\nreference = \"finest\"\n");
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("10: note: residual strength: the load reached"));
  const auto table = rows(file("results/study/table.csv"));
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0][9], "peak_load");
  EXPECT_EQ(table[0][13], "first_peak_load");
  EXPECT_EQ(table[1][13], table[1][9]);
  EXPECT_EQ(table[1][10], table[2][9]) << "the reference is the finest member's value";
  EXPECT_THAT(file("results/study/table.csv"), HasSubstr("rose again"));
  ASSERT_EQ(run_program(work(), {"run", "parts.toml"}).exit_status, 0);
  EXPECT_THAT(file("results/parts/summary.json"), HasSubstr("rose again"));
  EXPECT_THAT(file("results/parts/log.txt"), HasSubstr("rose again"));
  const auto summary = nlohmann::json::parse(file("results/parts/summary.json"));
  EXPECT_GT(summary["largest_load"], 2.0 * summary["peak_load"].get<double>());
}

TEST_F(Study, AMemberThatFailsDoesNotStopTheOthers) {
  // The horizon stays 0.6: no spacing of 1 can have it.
  const ProcessEnd end =
      converge("case = \"bar.toml\"\n[vary]\nspacing = [1, 0.25, 0.125]\n" + energy);
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("failed"));
  EXPECT_THAT(end.out, HasSubstr("body.horizon"));
  const auto table = rows(file("results/study/table.csv"));
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table[3][1], "1") << "failures come last";
  EXPECT_THAT(file("results/study/table.csv"), HasSubstr("body.horizon: is 0.6"));
}

TEST_F(Study, WhereAllMembersFailTheStatusAndTheFirstReasonSaySo) {
  const ProcessEnd end = converge("case = \"bar.toml\"\n[vary]\nspacing = [2e-7, 1e-7]\n" + energy);
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("every member of the study failed"));
  EXPECT_THAT(end.err, HasSubstr("body.spacing: gives about"));
}

TEST_F(Study, EveryErrorHasItsPictures) {
  ASSERT_EQ(converge(vary + "\n[[error]]\nquantity = \"strain_energy\"\nreference = \"finest\"\n" +
                     "\n[[error]]\nname = \"field of x/y\"\ndisplacement = [\"x\", \"y\"]\n")
                .exit_status,
            0);
  EXPECT_EQ(
      names("results/study"),
      (std::set<std::string>{"study.toml", "table.csv", "timing.csv",
                             "error_strain_energy_unknowns.svg", "error_strain_energy_seconds.svg",
                             "error_field_of_x_y_unknowns.svg", "error_field_of_x_y_seconds.svg"}));
}

TEST_F(Study, BadStudiesAreRefusedBeforeAnythingIsWritten) {
  struct Bad {
    std::string text, says;
  };
  for (const Bad& bad :
       {Bad{"case = \"nowhere.toml\"\n[vary]\nspacing = [2, 1]\n" + energy, "nowhere.toml"},
        Bad{vary + "horizon_ration = [2]\n" + energy, "horizon_ratio"},
        Bad{vary + "[error]\ndisplacement = [\"x\", \"(y\"]\n", "(y"},
        Bad{vary + "[error]\ndisplacement = [\"x\", \"y\", \"z\"]\n",
            "the case has 2 dimensions"}}) {
    const ProcessEnd end = converge(bad.text);
    EXPECT_EQ(end.exit_status, 2) << bad.text;
    EXPECT_THAT(end.err, HasSubstr(bad.says));
    EXPECT_FALSE(fs::exists(work() / "results")) << bad.text;
  }
}

TEST_F(Study, ASpacingOfAMeshIsRefusedOnceBeforeWorkBegins) {
  std::string meshed = tension_strip_case;
  meshed.replace(meshed.find("spacing = 0.25"), std::string("spacing = 0.25").size(),
                 "mesh = \"plate.geo\"");
  write_text(work() / "bar.toml", meshed);
  const ProcessEnd end = converge(vary + energy, {"--out", "r"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(
      end.err,
      HasSubstr("study.toml:4: vary.spacing: is given, but the body of the case is a mesh"));
  EXPECT_THAT(end.err, HasSubstr("refine with `mesh_size`"));
  EXPECT_FALSE(fs::exists(work() / "r"));
}

TEST_F(Study, AStudyThatTheCaseCannotHaveIsRefusedOnceBeforeWorkBegins) {
  const ProcessEnd end = converge("case = \"bar.toml\"\n[vary]\nspacing = [2, 1]\n" + energy,
                                  {"--out", "r"});  // the horizon is 0.6
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("study.toml: vary: leaves no member that the case accepts\n"));
  EXPECT_THAT(end.err, HasSubstr("body.horizon: is 0.6"));
  EXPECT_FALSE(fs::exists(work() / "r"));
}

TEST_F(Study, AnEarlierResultIsRefusedAndForcedOnRequest) {
  ASSERT_EQ(converge(vary + energy, {"--quiet"}).exit_status, 0);
  const ProcessEnd refused = converge(vary + energy, {"--quiet"});
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(converge(vary + energy, {"--quiet", "--force"}).exit_status, 0);
  const ProcessEnd own = run_program(
      work(), {"converge", "results/study/study.toml", "--out", "results/study", "--force"});
  EXPECT_EQ(own.exit_status, 2);
  EXPECT_THAT(own.err, HasSubstr("would overwrite this study"));
}

}  // namespace
}  // namespace perilink::test
