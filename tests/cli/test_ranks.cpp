// The program under mpiexec: results do not depend on the number of processes. Builds without MPI
// test only the message.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "support/rank_runs.hpp"

namespace perilink::test {
namespace {

using testing::HasSubstr;

/// The bar with a notch from below that runs half through it, in which bonds fail.
std::string breaking_case(bool in_space, const std::string& body, const std::string& law,
                          const std::string& analysis) {
  std::string text = replaced(bar_case(in_space, body), "\"infinite\"", "0.01\n" + law);
  text = replaced(text, "\"elastic\"", "\"damage\"");
  const std::string notch =
      in_space ? "corners = [[9.5, -1, -1], [9.5, 2.4, -1], [9.5, 2.4, 6], [9.5, -1, 6]]"
               : "points = [[9.5, -1], [9.5, 2.4]]";
  return text + analysis + "\n[[cracks]]\n" + notch + "\n";
}

/// The bar with its notch moved through time, so fine that there are blocks for four ranks.
std::string explicit_case(const std::string& body, const std::string& law) {
  std::string text =
      breaking_case(false, body, law, "duration = 0.02\nramp_time = 0.01\nrows = 30\n");
  text = replaced(text, "\"damage\"\nsolver = \"iterative\"", "\"explicit\"");
  text = replaced(text, "spacing = 1", "spacing = 0.25");
  text = replaced(text, "[3, 1]", "[20, 1]");
  return replaced(text, "fracture_energy", "density = 1e-3\nfracture_energy");
}

/// With some seconds of work.
std::string prolonged(const std::string& text) {
  return replaced(replaced(text, "duration = 0.02", "duration = 5"), "rows = 30", "rows = 30000");
}

const std::string softening = "tensile_strength = 3\nsoftening = \"linear\"\n";

const std::string springs = "\n[[springs]]\nregion = \"bar\"\ntotal = [2e3, 5e3]\n";

/// From a face to the middle of the bar, slightly inclined.
const std::string notch_in_space =
    "\n[[cracks]]\ncorners = [[8.2, 0, -1], [8.2, 2.4, -1], [9.3, 2.4, 6], [9.3, 0, 6]]\n";
const std::string crack_in_plane = "\n[[cracks]]\npoints = [[-1, 2.5], [8, 2.5], [9.3, 3.6]]\n";

const std::string gauges =
    "\n[[gauges]]\nname = \"tip\"\nregion = \"right\"\naxis = \"y\"\n"
    "\n[[gauges]]\nname = \"longer\"\nbetween = [[0, 2, 2], [20, 2, 2]]\n"
    "\n[[gauges]]\nname = \"stress\"\nregion = \"right\"\nstress = \"xx\"\n";

const std::string slipping_bar = R"(
[[rebar]]
from = [0.3, 1.1]
to = [19.7, 3.9]
youngs_modulus = 200e3
area = 0.05
bond = "linear"
bond_stiffness = 5e3
bond_strength = 2
)";

class RankRuns : public RankFolder, public testing::WithParamInterface<RankCase> {};

TEST_P(RankRuns, FindTheSameAnswer) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  const ProcessEnd alone = run_program(work(), {"run", "c.toml", "--out", "r1"});
  ASSERT_EQ(alone.exit_status, 0) << alone.err;
  const std::vector<double> expected = numbers_of(history("r1"));
  ASSERT_GT(expected.size(), 5u);
  for (const int count : {2, 4}) {
    const std::string directory = "r" + std::to_string(count);
    const ProcessEnd end = run_ranks(count, "run c.toml --out " + directory);
    ASSERT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("by " + std::to_string(count) + " ranks"));
    EXPECT_EQ(summary(directory).at("ranks"), count);
    const std::vector<double> found = numbers_of(history(directory));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (std::abs(expected[k]) < 1e-8) continue;  // residuals
      EXPECT_NEAR(found[k], expected[k], 1e-9 * std::abs(expected[k])) << "number " << k;
    }
  }
}

class ExplicitRankRuns : public RankFolder, public testing::WithParamInterface<RankCase> {};

/// Blocks of particles are summed over in one order by any number of ranks.
TEST_P(ExplicitRankRuns, WriteTheSameBytes) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  ASSERT_EQ(run_program(work(), {"run", "c.toml", "--out", "r1"}).exit_status, 0);
  EXPECT_GT(summary("r1").at("broken_bonds"), 20);
  for (const int count : {2, 3, 4}) {
    const std::string directory = "r" + std::to_string(count);
    const ProcessEnd end = run_ranks(count, "run c.toml --out " + directory);
    ASSERT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("by " + std::to_string(count) + " ranks"));
    EXPECT_EQ(summary(directory).at("ranks"), count);
    EXPECT_EQ(summary(directory).at("peak_load"), summary("r1").at("peak_load"));
    EXPECT_EQ(history(directory), history("r1"));
    for (const auto& file : fs::directory_iterator(work() / "r1")) {
      if (file.path().extension() != ".vtu") continue;
      EXPECT_EQ(read_text(work() / directory / file.path().filename()), read_text(file.path()));
    }
  }
}

TEST_F(RankFolder, SayWhatIsWrongOnce) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  // No case, a body that can turn, a support outside it.
  const std::string held = bar_case(true, "");
  write_text(work() / "free.toml", replaced(held, R"("x", "y", "z")", R"("x")"));
  write_text(work() / "beside.toml", replaced(held, "x = [0, 0]", "x = [-2, -1]"));
  for (const std::string name : {"missing.toml", "free.toml", "beside.toml"}) {
    const ProcessEnd end = run_ranks(3, "run " + name);
    EXPECT_EQ(end.exit_status, 2) << name;
    EXPECT_NE(end.err.find(name), std::string::npos) << end.err;
    EXPECT_EQ(end.err.find("perilink: ", end.err.find("perilink: ") + 1), std::string::npos)
        << end.err;
  }
}

/// Bodies and analyses that ranks do not share are refused before work begins.
TEST_F(RankFolder, RefuseWhatTheyCannotShare) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  const std::string bar = driven(bar_case(false, ""));
  const std::string lattice = replaced(
      replaced(driven(bar_case(false, "model = \"lattice\"\n")), "horizon_ratio = 3\n", ""),
      "fracture_energy", "density = 1e-3\nfracture_energy");
  write_text(work() / "relaxation.toml",
             replaced(bar, "\"elastic\"\nsolver = \"iterative\"", "\"relaxation\""));
  write_text(work() / "lattice.toml", lattice);
  write_text(work() / "particles.toml", replaced(lattice, "\"lattice\"", "\"particles\""));
  const std::vector<std::array<std::string, 3>> refused = {
      {"relaxation.toml", "analysis.type: is \"relaxation\"", "\"elastic\", \"damage\""},
      {"lattice.toml", "body.model: is \"lattice\"", "\"bond_based\" and \"micropolar\""},
      {"particles.toml", "body.model: is \"particles\"", "\"bond_based\" and \"micropolar\""}};
  for (const auto& [name, given, allowed] : refused) {
    const ProcessEnd end = run_ranks(2, "run " + name + " --out none");
    EXPECT_EQ(end.exit_status, 2) << name;
    EXPECT_THAT(end.err, HasSubstr(name));
    EXPECT_THAT(end.err, HasSubstr(given + ", which does not run on the 2 processes of mpiexec"));
    EXPECT_THAT(end.err, HasSubstr(allowed));
    EXPECT_THAT(end.err, HasSubstr("start one process without mpiexec"));
    EXPECT_FALSE(fs::exists(work() / "none"));
  }
}

class RankKills : public RankFolder, public testing::WithParamInterface<RankCase> {};

TEST_P(RankKills, EndAllTogether) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  const std::string out = "killed_" + std::to_string(getpid()), words = "run c.toml --out " + out;
  // In mid-run. mpiexec has these words, too; the newest process is a rank.
  const std::string lines = GetParam().name == "Elastic" ? "summary.json 2>/dev/null | wc -l) -ge 1"
                                                         : "history.csv 2>/dev/null | wc -l) -ge 3";
  const std::string has_begun = "[ $(cat " + out + "/" + lines + " ]";
  std::thread killer([&] {
    const std::string command = "cd '" + work().string() +
                                "'; for k in $(seq 600); do [ $(pgrep -fc '" + words +
                                "$') -ge 3 ] && " + has_begun +
                                " && break; sleep 0.05; done; pkill -9 -n -f '" + words + "$'";
    EXPECT_EQ(std::system(command.c_str()), 0) << "no process was killed";
  });
  const ProcessEnd end = run_ranks(2, words);
  killer.join();
  EXPECT_NE(end.exit_status, 0);
  EXPECT_THAT(end.err, HasSubstr("signal 9"));
  EXPECT_EQ(summary(out).at("status"), "running");
}

/// Cases are named by the words of the signal.
class RankStops : public RankFolder, public testing::WithParamInterface<RankCase> {};

/// mpiexec of Open MPI makes SIGTERM to all ranks of what stops it, and kills them a second later.
/// Given more, on a busy machine, the first ends its run in good order, and the others go along.
TEST_P(RankStops, KeepWhatTheyFound) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  const std::string out = "stopped_" + std::to_string(getpid()), words = "run c.toml --out " + out;
  std::thread stopper([&] {
    const std::string command = "cd '" + work().string() + "'; for k in $(seq 600); do [ $(cat " +
                                out + "/history.csv 2>/dev/null | wc -l) -ge 3 ] && break; " +
                                "sleep 0.05; done; pkill " + GetParam().name + words + "$'";
    EXPECT_EQ(std::system(command.c_str()), 0) << "no process was stopped";
  });
  setenv("OMPI_MCA_odls_base_sigkill_timeout", "4", 1);
  run_ranks(2, words);
  unsetenv("OMPI_MCA_odls_base_sigkill_timeout");
  stopper.join();
  EXPECT_EQ(summary(out).at("status"), "interrupted");
}

class RankMemory : public RankFolder, public testing::WithParamInterface<RankCase> {};

/// If a rank has no memory for its part, a solve, or a run whose parts are already sent, the others
/// do not wait.
TEST_P(RankMemory, EndsTogetherWhereOneHasNone) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  write_text(work() / "c.toml", GetParam().text);
  const std::string words = std::string("'") + PERILINK_PROGRAM + "' run c.toml --threads 1";
  const std::string free = fmt::format("-n 1 {} --force", words);
  const auto limited = [&](int megabytes) {
    return fmt::format("-n 1 sh -c \"ulimit -v {}; exec {} --force\"", 1000 * megabytes, words);
  };
  std::vector<std::string> pairs = {free + " : " + limited(600)};
  for (const int megabytes : {550, 600, 650, 700}) {
    pairs.push_back(limited(megabytes) + " : " + free);
  }
  for (const std::string& both : pairs) {
    const std::string command = fmt::format(
        "cd '{}' && timeout 300 env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 mpiexec {} >out 2>&1",
        work().string(), both);
    EXPECT_NE(WEXITSTATUS(std::system(command.c_str())), 124) << both << ": they wait";
  }
}

TEST_F(RankFolder, HaveOneCommandAlone) {
  if (!fs::exists(mpi_program())) GTEST_SKIP() << "built without MPI";
  const ProcessEnd end =
      run_ranks(1, std::string("run a.toml : -n 1 '") + PERILINK_PROGRAM + "' run b.toml");
  EXPECT_NE(end.exit_status, 0);
  EXPECT_THAT(end.err, HasSubstr("different commands"));
}

TEST_F(RankFolder, WithoutMpiTheFirstSaysSo) {
  // A copy without perilink-mpi in its folder.
  fs::copy_file(PERILINK_PROGRAM, work() / "perilink");
  const std::string command = "cd '" + work().string() + "' && OMPI_COMM_WORLD_SIZE=2 " +
                              "OMPI_COMM_WORLD_RANK=0 ./perilink --version 2>err >out";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(read_text(work() / "err"), HasSubstr("this build has no MPI"));
}

// mpiexec, which is the oldest, or all ranks.
INSTANTIATE_TEST_SUITE_P(
    Processes, RankStops,
    testing::Values(RankCase{"-TERM -o -f '", prolonged(explicit_case("", ""))},
                    RankCase{"-TERM -f '^[^ ]*perilink ", prolonged(explicit_case("", softening))}),
    [](const auto& instance) { return instance.index == 0 ? "Mpiexec" : "All"; });

// Each has some seconds of work.
INSTANTIATE_TEST_SUITE_P(
    Kinds, RankKills,
    testing::Values(RankCase{"Elastic",
                             replaced(bar_case(true, ""), "spacing = 1", "spacing = 0.3")},
                    RankCase{"Damage", replaced(breaking_case(true, "", "", ""), "spacing = 1",
                                                "spacing = 0.5")},
                    RankCase{"Explicit", prolonged(explicit_case("", ""))}),
    [](const auto& instance) { return instance.param.name; });

// The 40 501 particles of the second leave no room below some 670 MB once their parts are cut.
INSTANTIATE_TEST_SUITE_P(
    Kinds, RankMemory,
    testing::Values(
        RankCase{"Elastic", replaced(bar_case(true, ""), "spacing = 1", "spacing = 0.3")},
        RankCase{"Explicit",
                 replaced(replaced(explicit_case("", ""), "spacing = 0.25", "spacing = 0.05"),
                          "duration = 0.02\nramp_time = 0.01",
                          "strain = \"green\"\nduration = 5e-4\nramp_time = 2e-4")}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Bodies, ExplicitRankRuns,
    testing::Values(RankCase{"Brittle", explicit_case("", "")},
                    RankCase{"Softening", explicit_case("", softening)},
                    RankCase{"OnSprings", explicit_case("", "") + springs},
                    RankCase{"SlippingBar", explicit_case("", "") + slipping_bar},
                    RankCase{"Micropolar", explicit_case("model = \"micropolar\"\n", "")}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Bodies, RankRuns,
    testing::Values(
        RankCase{"Plane", bar_case(false, "")}, RankCase{"Space", bar_case(true, "")},
        RankCase{"MicropolarPlane", bar_case(false, "model = \"micropolar\"\n")},
        RankCase{"MicropolarSpace", bar_case(true, "model = \"micropolar\"\n")},
        RankCase{"OnSprings", bar_case(false, "") + springs},
        RankCase{"FaceCentred", replaced(bar_case(true, "pattern = \"face_centred\"\n"),
                                         "_ratio = 3", "_ratio = 2")},
        RankCase{"Notched", bar_case(true, "") + notch_in_space + gauges},
        RankCase{
            "CrackedFrames",
            bar_case(false, "model = \"micropolar\"\nsurface = \"energy\"\n") + crack_in_plane},
        RankCase{"Breaking", breaking_case(true, "", "", "[stop]\nbroken_bonds = 60\n")},
        RankCase{"BreakingInTwo", driven(breaking_case(false, "", "", ""))},
        RankCase{"BreakingBySteps",
                 breaking_case(false, "", "", "control = \"steps\"\nload_factors = [1, 2, 3]\n")},
        RankCase{"Softening", breaking_case(false, "", softening, "[stop]\nbroken_bonds = 5\n") +
                                  "closing = false\n"},
        RankCase{"MicropolarBreaking", breaking_case(false, "model = \"micropolar\"\n", "",
                                                     "[stop]\nbroken_bonds = 20\n")}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace perilink::test
