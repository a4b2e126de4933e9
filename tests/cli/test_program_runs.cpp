// Longer runs of the program from outside: signals, threads, three dimensions.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;

class ProgramRuns : public testing::Test {
 protected:
  ProgramRuns() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  std::string history(const std::string& directory) const {
    return read_text(work() / directory / "history.csv");
  }
  nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(read_text(work() / directory / "summary.json"));
  }

  TemporaryDirectory temporary_;
};

/// Expects a header and rows of as many fields, numbered from one, each with its line end.
/// \return number of rows
int expect_whole_rows(const std::string& text) {
  EXPECT_FALSE(text.empty());
  EXPECT_TRUE(text.empty() || text.back() == '\n') << "the last row is cut";
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  EXPECT_EQ(commas, 12);
  int rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    EXPECT_TRUE(line.starts_with(std::to_string(rows) + ",")) << line;
  }
  return rows;
}

/// A signal, and whether the run moves in time.
class StopSignals : public ProgramRuns,
                    public testing::WithParamInterface<std::tuple<int, bool>> {};

TEST_P(StopSignals, KeepTheResultsSoFar) {
  const auto [signal, moves] = GetParam();
  write_text(work() / "long.toml",
             moves ? lattice_strip_case(0.02, "safety = 1e-4\n") : hexagonal_case(86, 1000000));
  ProgramProcess process(work(), {"run", "long.toml", "--out", "r", "--threads", "1"});
  ASSERT_TRUE(process.wait_until([&] { return fs::exists(work() / "r/fields.pvd"); }));
  process.send(signal);
  const ProcessEnd end = process.wait();
  EXPECT_EQ(end.exit_status, 4) << end.err;
  const auto json = summary("r");
  EXPECT_EQ(json["status"], "interrupted");
  const int steps = json["steps"];
  if (moves) {
    EXPECT_NE(history("r").find(fmt::format("\n{},", steps)), std::string::npos) << "the last row";
  } else {
    EXPECT_EQ(expect_whole_rows(history("r")), steps);
  }
  // The first field file of a run by events, the last one of a run in time.
  EXPECT_TRUE(fs::exists(work() / "r" / fmt::format("fields_{:06}.vtu", moves ? steps : 1)));
  EXPECT_EQ(run({"plot", "r"}).exit_status, 0);
}

INSTANTIATE_TEST_SUITE_P(Signals, StopSignals,
                         testing::Combine(testing::Values(SIGINT, SIGTERM, SIGHUP),
                                          testing::Bool()),
                         [](const auto& test) {
                           const int signal = std::get<0>(test.param);
                           return std::string(signal == SIGINT    ? "Int"
                                              : signal == SIGTERM ? "Term"
                                                                  : "Hup") +
                                  (std::get<1>(test.param) ? "InTime" : "");
                         });

/// A run on a terminal of its own, which is closed while progress is drawn on it.
TEST_F(ProgramRuns, KeepTheirResultsWhenTheirTerminalIsClosed) {
  write_text(work() / "long.toml", lattice_strip_case(0.02, "safety = 1e-2\n"));
  std::string program = PERILINK_PROGRAM;
  std::string words[] = {"run", "long.toml", "--out", "r", "--threads", "1"};
  std::vector<char*> arguments = {program.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (chdir(work().c_str()) != 0) _exit(126);
    std::signal(SIGHUP, SIG_DFL);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  std::string drawn;
  char text[256];
  for (ssize_t size = 1; size > 0 && drawn.find("step ") == std::string::npos;) {
    size = read(terminal, text, sizeof text);
    if (size > 0) drawn.append(text, static_cast<std::size_t>(size));
  }
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " after " << drawn;
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_EQ(summary("r")["status"], "interrupted");
}

/// A closed pipe on standard output does not stop a run.
TEST_F(ProgramRuns, EndWellWhenNobodyReadsTheirOutput) {
  write_text(work() / "small.toml", small_ghost_case);
  const std::string command = "cd " + work().string() + " && (" + PERILINK_PROGRAM +
                              " run small.toml --out r; echo $? > status) 2>&1 | true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_text(work() / "status"), "0\n");
  EXPECT_EQ(summary("r")["broken_bonds"], 30);
}

TEST_F(ProgramRuns, KilledOnesLeaveAReadableHistory) {
  write_text(work() / "long.toml", hexagonal_case(86, 1000000));
  ProgramProcess process(work(), {"run", "long.toml", "--out", "r", "--threads", "1"});
  // Rows reach the file twice a second.
  ASSERT_TRUE(process.wait_until([&] { return history("r").size() > 2000; }));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  EXPECT_GT(expect_whole_rows(history("r")), 10);
  EXPECT_EQ(summary("r")["status"], "running");
  EXPECT_EQ(run({"plot", "r"}).exit_status, 0) << "results of a killed run are worth a look";
  EXPECT_EQ(run({"run", "long.toml", "--out", "r"}).exit_status, 2) << "and are not overwritten";
}

/// The hexagonal block with bonds that bend.
std::string micropolar_case(int columns, int broken_bonds) {
  std::string text = hexagonal_case(columns, broken_bonds);
  const auto add = [&](const std::string& before, const std::string& line) {
    for (auto at = text.find(before); at != std::string::npos;
         at = text.find(before, at + line.size() + before.size())) {
      text.insert(at, line);
    }
  };
  add("pattern = ", "model = \"micropolar\"\nsurface = \"none\"\n");
  add("youngs_modulus = ", "poissons_ratio = 0.2\n");
  return text;
}

TEST_F(ProgramRuns, TakeAsManyThreadsAsTheEnvironmentSays) {
  write_text(work() / "small.toml", small_ghost_case);
  setenv("OMP_NUM_THREADS", "3", 1);
  const ProcessEnd end = run({"run", "small.toml", "--out", "r"});
  unsetenv("OMP_NUM_THREADS");
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(summary("r")["threads"], 3);
}

/// Not a bit of the history may depend on the threads or on the run.
TEST_F(ProgramRuns, HistoriesDoNotDependOnThreads) {
  write_text(work() / "small.toml", small_ghost_case);
  write_text(work() / "micropolar.toml", micropolar_case(24, 100));
  // Far above the size from which all threads work on one factor (smallest_parallel_factor).
  write_text(work() / "large.toml", hexagonal_case(42, 300));
  for (const std::string name : {"small", "micropolar", "large"}) {
    int number = 0;
    for (const char* threads : {"1", "1", "2", "3"}) {
      const std::string directory = name + std::to_string(number++);
      const ProcessEnd end =
          run({"run", name + ".toml", "--out", directory, "--threads", threads, "--quiet"});
      ASSERT_EQ(end.exit_status, 0) << end.err;
      EXPECT_EQ(summary(directory)["threads"], std::stoi(threads));
      EXPECT_TRUE(history(directory) == history(name + "0")) << name << ", threads " << threads;
    }
    expect_whole_rows(history(name + "0"));
  }
  const auto large = summary("large0");
  EXPECT_GT(large["factor_bytes"].get<double>(), 8.0 * 2e6) << "too small to use threads";
  EXPECT_GT(large["unknowns"].get<int>(), 10000);
  EXPECT_EQ(large["broken_bonds"], 300);
  EXPECT_EQ(summary("micropolar0")["broken_bonds"], 100);
  EXPECT_LT(summary("micropolar0")["largest_residual"].get<double>(), 1e-10);
}

/// Text with every `from` replaced.
std::string all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The elastic strip, and the block in tension refined and torn fast: some ten thousand particles,
/// enough that every thread has work.
TEST_F(ProgramRuns, HistoriesOfExplicitRunsDoNotDependOnThreads) {
  write_text(work() / "strip.toml",
             all_replaced(lattice_strip_case(0.014), "duration = 2", "duration = 0.2"));
  std::string block = read_text(PERILINK_SOURCE_DIR "/meshes/splm_tension.toml");
  block = all_replaced(block, "spacing = 0.01", "spacing = 0.0025");
  block = all_replaced(block, "duration = 0.0504", "duration = 1.5e-4");
  block = all_replaced(block, "ramp_time = 0.04032", "ramp_time = 1.5e-4");
  write_text(work() / "block.toml", all_replaced(block, "[0.01, 0.015, 0.02]", "[]"));
  for (const std::string name : {"strip", "block"}) {
    for (const char* threads : {"1", "2"}) {
      const ProcessEnd end =
          run({"run", name + ".toml", "--out", name + threads, "--threads", threads});
      ASSERT_EQ(end.exit_status, 0) << end.err;
    }
    EXPECT_GT(summary(name + "1")["particles"].get<int>(), 8000) << "too small for two threads";
    EXPECT_GT(history(name + "1").size(), 5000u);
    EXPECT_TRUE(history(name + "1") == history(name + "2")) << name;
  }
  EXPECT_GT(summary("block1")["cracked_particles"].get<int>(), 1000);
}

TEST_F(ProgramRuns, NotesAndDoubtsOfALatticeStandInItsLog) {
  std::string text = lattice_strip_case();
  text.insert(text.find("youngs_modulus"), "holes = [\"hole\"]\n");
  text.replace(text.find("ramp_time = 1"), 13, "ramp_time = 0.2");  // a ninth of the period
  text += "[[regions]]\nname = \"hole\"\ncenter = [1, 0.52]\nradius = 0.05\n";
  write_text(work() / "strip.toml", text);
  ASSERT_EQ(run({"run", "strip.toml", "--out", "r"}).exit_status, 0);
  const std::string log = read_text(work() / "r/log.txt");
  EXPECT_THAT(log, testing::HasSubstr("note: 1 particle was in the hole \"hole\""));
  EXPECT_THAT(log, testing::HasSubstr("warning: the peaks of load and reaction differ by"));
}

struct BarCase {
  const char* pattern;
  double coarse;   ///< spacing
  double fine;     ///< spacing
  double modulus;  ///< Young's modulus along the cubes' edges over the mean of all directions
};

void PrintTo(const BarCase& bar, std::ostream* stream) { *stream << bar.pattern; }

class ElasticBars : public ProgramRuns, public testing::WithParamInterface<BarCase> {};

/// A bond lattice is a cubic crystal: along the cubes' edges its Young's modulus is (C11 - C12)
/// (C11 + 2 C12) / (C11 + C12) with C11 ~ sum x^4 / xi^3 and C12 ~ sum x^2 y^2 / xi^3 over the
/// neighbourhood, scaled so that C11 + 2 C12 = 2 E. Particles at the surface lack bonds, which
/// softens the bar in proportion to horizon / width; two spacings extrapolate to none of that. What
/// is left is quadratic in the spacing.
TEST_P(ElasticBars, StretchByForceTimesLengthOverStiffness) {
  const BarCase& bar = GetParam();
  std::vector<double> displacement;
  std::vector<double> spacing;
  for (const double wanted : {bar.coarse, bar.fine}) {
    write_text(work() / "bar.toml", tension_bar_case(bar.pattern, wanted, "none"));
    const ProcessEnd end = run({"run", "bar.toml", "--force"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out, testing::HasSubstr("elastic equilibrium"));
    const auto json = summary("results/bar");
    EXPECT_LT(json["largest_residual"].get<double>(), 1e-10);
    displacement.push_back(json["peak_displacement"]);
    spacing.push_back(json["spacing"]);
  }
  const double expected = 2.0 * 4.0 / (100.0 * bar.modulus * 1.0);
  EXPECT_GT(displacement[0], displacement[1]);
  EXPECT_GT(displacement[1], expected);
  const double slope = (displacement[0] - displacement[1]) / (spacing[0] - spacing[1]);
  EXPECT_NEAR(displacement[1] - slope * spacing[1], expected, 0.1 * expected);
}

/// Uniform tension is a patch test: calibrated bars stretch by F l / (E A) at any spacing.
TEST_P(ElasticBars, StretchExactlyWhereBondsAreCalibrated) {
  write_text(work() / "bar.toml", tension_bar_case(GetParam().pattern, 0.25, "calibrated"));
  const ProcessEnd end = run({"run", "bar.toml", "--force"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_NEAR(summary("results/bar")["peak_displacement"].get<double>(), 2.0 * 4.0 / 100.0, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Patterns, ElasticBars,
                         testing::Values(BarCase{"cubic", 1.0 / 8, 1.0 / 12, 1.1131},
                                         BarCase{"face_centred", M_SQRT1_2 / 6, M_SQRT1_2 / 8,
                                                 0.8364}),
                         [](const auto& bar) { return std::string(bar.param.pattern); });

/// A cantilever of unit height, fixed at x <= 3, with a load or a displacement across its last two
/// columns.
std::string cantilever_case(int length, const std::string& load, const std::string& analysis) {
  return fmt::format(R"([body]
surface = "none"
spacing = 1
horizon_ratio = 3.1

[[regions]]
name = "bar"
x = [0, {0}]
y = [0, 2]

[[regions]]
name = "left"
x = [0, 3]
y = [0, 2]

[[regions]]
name = "right"
x = [{1}, {0}]
y = [0, 2]

[[materials]]
region = "bar"
youngs_modulus = 3604
fracture_energy = 0.001

[[supports]]
region = "left"
fix = ["x", "y"]

{2}

[analysis]
type = "{3}"
)",
                     length, length - 1, load, analysis);
}

/// Double precision leaves some 1e-5 of the load out of balance in a cantilever a thousand times as
/// long as high. The run succeeds and reports this in print and in the summary. The force is small
/// enough for small displacements.
TEST_F(ProgramRuns, DoubtResultsThatRoundOffHasReached) {
  const std::string force = "[[loads]]\nregion = \"right\"\nforce = [0, 1e-12]";
  write_text(work() / "slender.toml", cantilever_case(2000, force, "elastic"));
  const ProcessEnd end = run({"run", "slender.toml", "--out", "r"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  const nlohmann::json result = summary("r");
  EXPECT_GT(result["largest_residual"].get<double>(), 1e-6);
  ASSERT_EQ(result["warnings"].size(), 1u);
  const std::string warning = result["warnings"][0];
  EXPECT_THAT(warning, testing::HasSubstr("of the load is out of balance"));
  EXPECT_THAT(end.out, testing::HasSubstr(warning));
  EXPECT_THAT(read_text(work() / "r/log.txt"), testing::HasSubstr("warning: " + warning));
}

/// Ten and twenty thousand times as long as high: the factor's answers are 0.2 and some 10 % off,
/// those of conjugate gradients grow with the third power of the length. Work and energy differ.
TEST_F(ProgramRuns, AnEquilibriumThatRoundOffHasLostIsAFailure) {
  const std::string force = "[[loads]]\nregion = \"right\"\nforce = [0, 1e-12]";
  const auto solve = [&](int length) {
    write_text(work() / "slender.toml",
               cantilever_case(length, force, "elastic\"\nsolver = \"direct"));
    return run({"run", "slender.toml", "--out", "r", "--force"});
  };
  // Out of balance by 2e-4 to 5e-4 with three kernels of OpenBLAS; 20000 long by 7e-5 to 3e-2.
  EXPECT_EQ(solve(12000).exit_status, 0);
  EXPECT_GT(summary("r")["energy_error"].get<double>(), 1e-6);
  EXPECT_EQ(summary("r")["warnings"].size(), 2u);
  const ProcessEnd end = solve(40000);
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.err, testing::HasSubstr("work and energy are out of balance by 0."));
  EXPECT_THAT(end.err, testing::HasSubstr("(solver = \"iterative\") lose fewer digits"));
  EXPECT_EQ(summary("r")["status"], "failed");
}

/// The load in the last row is zero, not round-off, also in the picture.
TEST_F(ProgramRuns, ASeparatedBodyBearsNoLoad) {
  const std::string drive = "[[displacements]]\nregion = \"right\"\ny = -1";
  write_text(work() / "driven.toml", cantilever_case(60, drive, "damage"));
  ASSERT_EQ(run({"run", "driven.toml", "--out", "r"}).exit_status, 0);
  const nlohmann::json result = summary("r");
  EXPECT_EQ(result["status"], "collapsed");
  EXPECT_EQ(result["warnings"].size(), 0u);
  const std::string text = history("r");
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  std::istringstream cells(last);
  std::string cell;
  for (int k = 0; k < 4; ++k) std::getline(cells, cell, ',');
  EXPECT_EQ(cell, "0") << last;
  ASSERT_EQ(run({"plot", "r"}).exit_status, 0);
  const int row = result["steps"];
  EXPECT_THAT(read_text(work() / fmt::format("r/fields_{:06}.svg", row)),
              testing::HasSubstr(" · load 0 · "));
}

}  // namespace
}  // namespace perilink::test
