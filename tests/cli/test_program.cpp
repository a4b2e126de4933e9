// The program from outside: command line, exit statuses, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A directory to run the program in.
class Program : public testing::Test {
 protected:
  Program() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  void write_case(const std::string& name, const std::string& text) const {
    write_text(work() / name, text);
  }
  /// Content of every file below the working directory, by its path there.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(work())) {
      if (!entry.is_regular_file()) continue;
      found[entry.path().lexically_relative(work()).generic_string()] = read_text(entry.path());
    }
    return found;
  }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& [name, content] : files()) found.insert(name);
    return found;
  }

  TemporaryDirectory temporary_;
};

TEST_F(Program, HelpNamesEveryCommandAndOption) {
  const std::map<std::string, std::vector<std::string>> expected = {
      {"",
       {"--help", "--version", "run", "converge", "scan", "compare", "check", "plot", "report",
        "Exit status", "docs/case_file.md"}},
      {"run",
       {"case", "--out", "--threads", "--quiet", "--force", "--set", "--resume", "Exit status"}},
      {"converge",
       {"study", "--out", "--threads", "--quiet", "--force", "--set", "docs/studies.md"}},
      {"scan", {"scan", "--out", "--jobs", "--threads", "--quiet", "--force", "docs/studies.md"}},
      {"compare", {"dir_a", "dir_b", "--out", "--quiet", "--force", "docs/compare.md"}},
      {"check", {"case", "--set", "Exit status"}},
      {"plot",
       {"directory", "--out", "--scale", "--x", "--y", "--at", "--field", "--range", "--whole",
        "--png", "Exit status"}},
      {"report", {"directories", "--out", "--at", "--watch", "docs/report.md"}}};
  for (const auto& [command, words] : expected) {
    std::vector<std::string> arguments = {"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const ProcessEnd end = run(arguments);
    EXPECT_EQ(end.exit_status, 0) << command;
    EXPECT_EQ(end.err, "") << command;
    for (const std::string& word : words) EXPECT_THAT(end.out, HasSubstr(word)) << command;
  }
}

TEST_F(Program, VersionNamesTheProgram) {
  const ProcessEnd end = run({"--version"});
  EXPECT_EQ(end.exit_status, 0);
  EXPECT_TRUE(end.out.starts_with("perilink ")) << end.out;
  EXPECT_THAT(end.out, testing::ContainsRegex("\n +BLAS +/.*[.]so"));
}

TEST_F(Program, BadCommandLinesAreRefused) {
  write_case("a.toml", small_ghost_case);
  const std::vector<std::vector<std::string>> bad = {{},
                                                     {"simulate"},
                                                     {"--colour"},
                                                     {"run"},
                                                     {"run", "a.toml", "b.toml"},
                                                     {"run", "a.toml", "--threads", "0"},
                                                     {"run", "a.toml", "--threads", "many"},
                                                     {"run", "a.toml", "--fast"},
                                                     {"compare", "."},
                                                     {"compare", ".", ".", "."},
                                                     {"compare", ".", ".", "--threads", "1"},
                                                     {"check"},
                                                     {"check", "a.toml", "--set"},
                                                     {"scan"},
                                                     {"scan", "a.toml", "--jobs", "0"},
                                                     {"check", "a.toml", "--out", "x"},
                                                     {"plot"},
                                                     {"plot", ".", "--scale", "-1"},
                                                     {"plot", ".", "--at", "soon"},
                                                     {"plot", ".", "--range", "1"},
                                                     {"report", ".", "--at", "-1"},
                                                     {"report"},
                                                     {"report", ".", "--scale", "1"}};
  for (const auto& arguments : bad) {
    const ProcessEnd end = run(arguments);
    EXPECT_EQ(end.exit_status, 2) << testing::PrintToString(arguments);
    EXPECT_NE(end.err, "") << testing::PrintToString(arguments);
    EXPECT_EQ(end.out, "") << testing::PrintToString(arguments);
  }
  EXPECT_THAT(run({"simulate"}).err, HasSubstr("simulate"));
  EXPECT_THAT(run({"chek"}).err, HasSubstr("option chek\n  did you mean `check`?"));
  EXPECT_THAT(run({"run", "--thread=2"}).err, HasSubstr("--thread\n  did you mean `--threads`?"));
  EXPECT_THAT(run({"run"}).err, testing::StartsWith("perilink: case is required\n"));
  EXPECT_EQ(names(), std::set<std::string>{"a.toml"}) << "a refused command left files behind";
}

TEST_F(Program, MissingFilesAreNamed) {
  for (const char* command : {"run", "check"}) {
    const ProcessEnd end = run({command, "nowhere/case.toml"});
    EXPECT_EQ(end.exit_status, 2) << command;
    EXPECT_THAT(end.err, HasSubstr("nowhere/case.toml")) << command;
  }
  EXPECT_EQ(run({"run", "."}).exit_status, 2) << "a directory is no case";
  EXPECT_TRUE(fs::is_empty(work()));
}

TEST_F(Program, RunWritesTheFilesOfTheContractAndNoOthers) {
  write_case("small.toml", small_ghost_case);
  const ProcessEnd end = run({"run", "small.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(end.err, "");
  for (const char* part : {"Small block", "completed", "30 broken bonds", "results/small"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  const std::string place = "results/small/";
  EXPECT_EQ(names(),
            (std::set<std::string>{
                "small.toml", place + "case.toml", place + "history.csv", place + "timing.csv",
                place + "summary.json", place + "fields.pvd", place + "fields_000001.vtu",
                place + "fields_000011.vtu", place + "fields_000021.vtu",
                place + "fields_000031.vtu", place + "cracks_000011.csv",
                place + "cracks_000021.csv", place + "cracks_000031.csv", place + "log.txt"}));
  const auto summary = nlohmann::json::parse(read_text(work() / place / "summary.json"));
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["broken_bonds"], 30);
  EXPECT_THAT(read_text(work() / place / "log.txt"), HasSubstr("30 broken bonds"));
  std::istringstream history(read_text(work() / place / "history.csv"));
  std::string line;
  std::getline(history, line);
  EXPECT_EQ(line,
            "step,broken_bonds,load_factor,load,displacement,strain_energy,dissipated_energy,"
            "external_work,released_energy,yield_events,residual,factorizations,element");
  for (int row = 1; row <= 31; ++row) {
    ASSERT_TRUE(std::getline(history, line)) << row;
    const std::string start = std::to_string(row) + "," + std::to_string(row - 1) + ",";
    EXPECT_TRUE(line.starts_with(start)) << line;
  }
  EXPECT_FALSE(std::getline(history, line)) << line;
  const std::string timing = read_text(work() / place / "timing.csv");
  EXPECT_TRUE(timing.starts_with("step,seconds\n1,")) << timing.substr(0, 40);
}

TEST_F(Program, AnEarlierResultIsRefusedByteForByteAndForcedOnRequest) {
  write_case("small.toml", small_ghost_case);
  ASSERT_EQ(run({"run", "small.toml", "--out", "r"}).exit_status, 0);
  write_case("bad.toml", "title = \"bad\"\n");
  write_text(work() / "r/notes.txt", "mine");
  write_text(work() / "r/fields_000999.vtu", "old");
  const auto before = files();
  const ProcessEnd refused = run({"run", "small.toml", "--out", "r"});
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(files(), before);
  EXPECT_EQ(run({"run", "bad.toml", "--out", "r", "--force"}).exit_status, 2);
  EXPECT_EQ(files(), before) << "a bad case removes no result";

  EXPECT_EQ(run({"run", "small.toml", "--out", "r", "--force"}).exit_status, 0);
  const auto after = files();
  EXPECT_EQ(after.at("r/notes.txt"), "mine");
  EXPECT_FALSE(after.contains("r/fields_000999.vtu"));
  EXPECT_EQ(after.at("r/history.csv"), before.at("r/history.csv"));
}

TEST_F(Program, AnEarlierResultIsRefusedBeforeTheModelIsBuilt) {
  std::string loose = small_ghost_case;
  loose.replace(loose.find("\"pin\""), 5,
                "\"refuse\"");  // only the model determines the supports of the body
  write_case("loose.toml", loose);
  EXPECT_THAT(run({"run", "loose.toml", "--out", "r"}).err, HasSubstr("rigid-body modes"));
  fs::create_directories(work() / "r");
  write_text(work() / "r/history.csv", "old");
  EXPECT_THAT(run({"run", "loose.toml", "--out", "r"}).err, HasSubstr("--force"));
}

TEST_F(Program, TheResolvedCaseRunsAgainToTheSameHistory) {
  write_case("small.toml", small_ghost_case);
  const ProcessEnd quiet = run({"run", "small.toml", "--out", "first", "--quiet"});
  ASSERT_EQ(quiet.exit_status, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  ASSERT_EQ(run({"run", "first/case.toml", "--out", "second"}).exit_status, 0);
  for (const char* file : {"history.csv", "case.toml", "fields_000031.vtu"}) {
    EXPECT_EQ(read_text(work() / "first" / file), read_text(work() / "second" / file)) << file;
  }
}

TEST_F(Program, ARunNotesBondsThatBrokeAtItsSupports) {
  const ProcessEnd end =
      run({"run", PERILINK_SOURCE_DIR "/meshes/plate_with_hole.toml", "--out", "r"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  const std::string note = "broken bonds end at particles of [[supports]] or [[displacements]]";
  EXPECT_THAT(end.out, HasSubstr(note));
  EXPECT_THAT(read_text(work() / "r/log.txt"), HasSubstr(note));
}

TEST_F(Program, CheckTellsSizesAndMakesNothing) {
  write_case("small.toml", small_ghost_case);
  const ProcessEnd end = run({"check", "small.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  for (const char* part :
       {"[body]", "particles          336", "bonds              2345", "unknowns           669",
        "memory", "time               about ", "per broken bond", " for 30 of them\n",
        "spacing            ", " spacings\n", "load               upper cap: (0, 100)",
        "region             upper cap: 40 particles, x 6.25 to 93.75, y 200 to 250\n"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  EXPECT_EQ(names(), std::set<std::string>{"small.toml"});
  write_case("again.toml", end.out);  // what it prints is a case with comments
  EXPECT_EQ(run({"check", "again.toml"}).exit_status, 0);
}

TEST_F(Program, CheckLeavesTheCalibrationToTheRun) {
  write_case("block.toml", hexagonal_case(9, 5));
  const ProcessEnd check = run({"check", "block.toml"});
  EXPECT_EQ(check.exit_status, 0) << check.err;
  EXPECT_THAT(check.out, testing::ContainsRegex(
                             "calibration        of [1-9][0-9]* bonds, about [0-9.]+ s at"));
  EXPECT_THAT(check.out, testing::Not(HasSubstr("out of balance")));
  ASSERT_EQ(run({"run", "block.toml", "--out", "r"}).exit_status, 0);
  EXPECT_THAT(read_text(work() / "r/log.txt"),
              testing::ContainsRegex("calibration: [0-9]+ bonds, forces out of balance"));
}

TEST_F(Program, CheckOfAMeshSpeaksOfItsEdges) {
  const ProcessEnd end = run({"check", PERILINK_SOURCE_DIR "/meshes/plate_with_hole.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, testing::ContainsRegex("mean edge          0.18[0-9]*, edges 0.076[0-9]* to "
                                              "0.395[0-9]*, horizon [0-9.]* = 3 mean edges\n"));
  EXPECT_THAT(end.out, testing::Not(HasSubstr("spacing")));
}

TEST_F(Program, CheckOfAnElasticCaseSpeaksOfNoBreaks) {
  write_case(
      "strip.toml",
      tension_strip_case + std::string("[[gauges]]\nname = \"g\"\nat = [1.1, 0.4]\naxis = \"x\""));
  const ProcessEnd end = run({"check", "strip.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("gauge              g: at (1.1, 0.4)\n"));
  EXPECT_THAT(end.out, testing::Not(HasSubstr("broken bond")));
}

TEST_F(Program, CheckOfAnExplicitCaseTellsItsSteps) {
  write_case("strip.toml", lattice_strip_case());
  const ProcessEnd end = run({"check", "strip.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  for (const char* part :
       {"model = \"lattice\"", "critical time step 0.00", "time step          0.00",
        "steps              ", "about 100 rows", "bonds              ",
        " s on one core, measured over ",
        // Rows are sqrt(3)/2 of a spacing apart: eleven of them fit above the first.
        "particles lie in   x 0 to 2, y 0 to 0.952628\n"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  EXPECT_THAT(end.out, testing::ContainsRegex("fundamental period 1\\.7[0-9]+[,\n]"));
  EXPECT_EQ(names(), std::set<std::string>{"strip.toml"});
  write_case("again.toml", end.out);
  EXPECT_EQ(run({"check", "again.toml"}).exit_status, 0);
}

/// The strip at a strain of 2e-4, drawn slowly and damped, and its elastic answer.
TEST_F(Program, ElasticLatticesAnswerAsSlowExplicitRunsDo) {
  std::string text = lattice_strip_case();
  text.replace(text.find("x = 0.04"), 8, "x = 0.0004");
  text.replace(text.find("internal_damping = 0.1"), 22, "external_damping = 0.5");
  text.replace(text.find("duration = 2"), 12, "duration = 30");
  text.replace(text.find("ramp_time = 1"), 13, "ramp_time = 20");
  write_case("moving.toml", text);
  write_case("elastic.toml", text.substr(0, text.find("[analysis]")) +
                                 "[[gauges]]\nname = \"middle\"\nat = [1, 0.5]\naxis = \"x\"\n"
                                 "[analysis]\ntype = \"elastic\"\n");
  EXPECT_EQ(run({"check", "elastic.toml"}).exit_status, 0);
  for (const char* name : {"moving", "elastic"}) {
    const ProcessEnd end = run({"run", std::string(name) + ".toml"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  const auto summary_of = [&](const std::string& name) {
    return nlohmann::json::parse(read_text(work() / "results" / name / "summary.json"));
  };
  const auto moving = summary_of("moving"), still = summary_of("elastic");
  // The remaining error comes from the true lengths, as large as the strain.
  const double load = still["peak_load"];
  EXPECT_NEAR(-moving["peak_reaction"].get<double>(), load, 1e-3 * load);
  const double energy = still["strain_energy"];
  EXPECT_NEAR(moving["strain_energy"].get<double>(), energy, 1e-3 * energy);
  EXPECT_GT(moving["fundamental_period"].get<double>(), 0.0);
  EXPECT_LT(still["largest_residual"].get<double>(), 1e-12);
  EXPECT_THAT(read_text(work() / "results/elastic/history.csv"), HasSubstr(",middle\n"));
  EXPECT_EQ(run({"plot", "results/elastic"}).exit_status, 0);
}

/// The strip under a force and its own weight, slowly and at once.
TEST_F(Program, LoadsOfLatticesMoveThemToTheElasticAnswer) {
  const std::string text = lattice_strip_case();
  const std::string body = text.substr(0, text.find("[[displacements]]"));
  const std::string loads =
      "[[loads]]\nregion = \"right side\"\nforce = [1e-3, 0]\n"
      "[[loads]]\nregion = \"strip\"\nbody_force = [1e-4, \"-1e-4*x\"]\n"
      "[[point_loads]]\nat = [1.01, 0.5]\nforce = [0, 2e-4]\n"
      "[[gauges]]\nname = \"tip\"\nregion = \"right side\"\naxis = \"y\"\n";
  const std::string damped = body.substr(0, body.find("internal_damping")) +
                             "external_damping = 0.7\n" + body.substr(body.find("[[supports]]"));
  write_case("moving.toml",
             damped + loads + "[analysis]\ntype = \"explicit\"\nduration = 40\nramp_time = 20\n");
  write_case("elastic.toml", damped + loads + "[analysis]\ntype = \"elastic\"\n");
  const ProcessEnd check = run({"check", "moving.toml"});
  EXPECT_THAT(check.out, HasSubstr("forces             "));
  EXPECT_THAT(check.out, HasSubstr("the point load at (1.01, 0.5) acts on the particle at"));
  for (const char* name : {"moving", "elastic"}) {
    const ProcessEnd end = run({"run", std::string(name) + ".toml"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  const auto last_value = [&](const std::string& name) {
    const std::string history = read_text(work() / "results" / name / "history.csv");
    return std::stod(history.substr(history.rfind(',') + 1));
  };
  EXPECT_NEAR(last_value("moving"), last_value("elastic"), 1e-3 * std::abs(last_value("elastic")));
  EXPECT_EQ(run({"compare", "results/moving", "results/elastic"}).exit_status, 0);
}

TEST_F(Program, ExplicitRunsWriteTheFilesOfTheContract) {
  write_case("strip.toml", lattice_strip_case(0.1, "\n[output]\nfields_times = [1]\n"));
  const ProcessEnd end = run({"run", "strip.toml"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(end.err, "");
  for (const char* part : {"Lattice strip", "completed", "particle-steps/s", "results/strip"}) {
    EXPECT_THAT(end.out, HasSubstr(part));
  }
  const std::string place = "results/strip/";
  const auto summary = nlohmann::json::parse(read_text(work() / place / "summary.json"));
  int fields = 0;
  for (const std::string& name : names()) fields += name.ends_with(".vtu");
  EXPECT_EQ(fields, 3);
  for (const char* name : {"case.toml", "history.csv", "timing.csv", "summary.json", "fields.pvd",
                           "fields_000000.vtu", "log.txt"}) {
    EXPECT_TRUE(names().contains(place + name)) << name;
  }
  // Strain 0.04 over 1.8 between the clamps, E = 100, height 1: the body is one half row stiffer.
  EXPECT_NEAR(-summary["peak_reaction"].get<double>(), 100.0 * 0.04 / 1.8, 0.15 * 2.22);
  EXPECT_LT(summary["energy_error"].get<double>(), 1e-3);
  ASSERT_EQ(run({"run", place + "case.toml", "--out", "again"}).exit_status, 0);
  EXPECT_EQ(read_text(work() / "again/history.csv"), read_text(work() / place / "history.csv"));
  EXPECT_EQ(read_text(work() / "again/case.toml"), read_text(work() / place / "case.toml"));

  const ProcessEnd plot = run({"plot", "again"});
  EXPECT_EQ(plot.exit_status, 0) << plot.err;
  EXPECT_THAT(read_text(work() / "again/fields_000000.svg"), HasSubstr("time 0 "));
  EXPECT_TRUE(fs::exists(work() / "again/load_displacement.svg"));
  EXPECT_EQ(run({"run", "strip.toml"}).exit_status, 2) << "an earlier result";
}

TEST_F(Program, PlotDrawsWhatAResultHolds) {
  write_case("small.toml", small_ghost_case);
  ASSERT_EQ(run({"run", "small.toml", "--out", "r"}).exit_status, 0);
  const ProcessEnd end = run({"plot", "r", "--out", "pictures"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  for (const char* name : {"load_displacement.svg", "fields_000001.svg", "fields_000011.svg",
                           "fields_000021.svg", "fields_000031.svg"}) {
    EXPECT_THAT(read_text(work() / "pictures" / name), HasSubstr("</svg>")) << name;
    EXPECT_THAT(end.out, HasSubstr(name));
  }
  EXPECT_EQ(run({"plot", "r"}).exit_status, 0);
  EXPECT_TRUE(fs::exists(work() / "r/fields_000031.svg"));
}

TEST_F(Program, PlotOfADirectoryWithoutResultsIsRefused) {
  fs::create_directories(work() / "empty");
  for (const auto& [directory, reason] : std::map<std::string, std::string>{
           {"empty", "is not a result of a run"}, {"nowhere", "there is no such directory"}}) {
    const ProcessEnd end = run({"plot", directory});
    EXPECT_EQ(end.exit_status, 2);
    EXPECT_THAT(end.err, HasSubstr(directory + ": " + reason));
  }
  EXPECT_TRUE(fs::is_empty(work() / "empty"));
}

}  // namespace
}  // namespace perilink::test
