// Too little memory from the system: the program reports it and ends, wherever it runs out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/whole_files.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr rlim_t megabyte = rlim_t{1} << 20;

class Memory : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "AddressSanitizer takes more address space than any limit";
#endif
    fs::create_directories(work());
    write_text(work() / "small.toml", small_ghost_case);
    write_text(work() / "large.toml", hexagonal_case(40, 50));
    write_text(work() / "bar.toml", tension_strip_case);
    write_text(work() / "study.toml",
               "case = \"bar.toml\"\n[vary]\nspacing = [0.25, 0.004]\nhorizon_ratio = [2]\n"
               "surface = [\"none\"]\n[error]\nquantity = \"strain_energy\"\nreference = 0.04\n");
  }
  fs::path work() const { return temporary_ / "work"; }

  /// Runs with so little address space, to the end whatever it is.
  ProcessEnd run(const std::vector<std::string>& words, int limit) const {
    ProgramProcess process(work(), words, {{RLIMIT_AS, limit * megabyte}});
    process.wait_until([] { return false; });  // a minute is enough
    process.send(SIGKILL);
    return process.wait();
  }

  TemporaryDirectory temporary_;
};

class LittleMemory : public Memory, public testing::WithParamInterface<int> {};

TEST_P(LittleMemory, EndsARunInWords) {
  for (const auto& words : {std::vector<std::string>{"run", "small.toml", "--out", "s"},
                            {"run", "large.toml", "--out", "l"},
                            {"check", "large.toml"},
                            {"converge", "study.toml", "--out", "c"}}) {
    const ProcessEnd end = run(words, GetParam());
    const std::string said = words[0] + " " + words[1] + ": " + end.err;
    EXPECT_EQ(end.signal, 0) << said;
    EXPECT_THAT(end.err, Not(HasSubstr("bad_alloc"))) << said;
    EXPECT_TRUE(end.exit_status == 0 || end.exit_status == 3) << end.exit_status << " " << said;
    EXPECT_EQ(end.err.find("emory") != std::string::npos, end.exit_status == 3) << said;
    if (end.exit_status == 3 && words[0] == "run" && fs::exists(work() / words[3])) {
      EXPECT_EQ(expect_whole_files(work() / words[3]), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Megabytes, LittleMemory, testing::Values(100, 150, 230, 280, 340),
                         [](const auto& limit) { return std::to_string(limit.param); });

TEST_F(Memory, BelowWhatTheLibrariesNeedIsRefusedAtOnce) {
  const ProcessEnd end = run({"run", "small.toml"}, 120);
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.err, HasSubstr("perilink: out of memory: the libraries of the program need"));
  EXPECT_FALSE(fs::exists(work() / "results"));
}

/// OpenMP would end the program with a status of its own.
TEST_F(Memory, WithoutRoomForTheThreadsFewerAreTaken) {
  for (const auto& [command, file] :
       {std::pair{"run", "small.toml"}, std::pair{"converge", "study.toml"}}) {
    const ProcessEnd end = run({command, file, "--threads", "1024", "--out", command}, 400);
    EXPECT_THAT(end.err, HasSubstr(" of 1024 threads: the limits on the process"));
    EXPECT_THAT(end.err, Not(HasSubstr("libgomp")));
    EXPECT_EQ(end.exit_status, 0) << end.err;
  }
  const ProcessEnd free = run_program(work(), {"run", "small.toml", "--threads", "1"});
  EXPECT_EQ(free.exit_status, 0);
  EXPECT_THAT(free.err, Not(HasSubstr("of 1024 threads")));
  EXPECT_EQ(read_text(work() / "run/history.csv"), read_text(work() / "results/small/history.csv"));
}

TEST_F(Memory, MeshesLargerThanItAreRefusedBeforeTheyAreRead) {
  write_text(work() / "huge.msh", "");
  fs::resize_file(work() / "huge.msh", std::uintmax_t{1} << 41);  // takes no room on the disk
  std::string text = small_ghost_case;
  text.replace(text.find("spacing = 12.5\nhorizon = 31.45\n"), 31,
               "mesh = \"huge.msh\"\nhorizon = 31.45\n");
  text.replace(text.find("surface = \"ghost\"\n"), 18, "");
  write_text(work() / "mesh.toml", text);
  const ProcessEnd end = run_program(work(), {"check", "mesh.toml"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, HasSubstr("huge.msh: has 2199 GB, reading it takes"));
}

}  // namespace
}  // namespace perilink::test
