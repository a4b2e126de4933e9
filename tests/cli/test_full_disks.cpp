// Disks without room from outside: runs end as failed with what they found, every file is whole.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/whole_files.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FullDisks : public testing::Test {
 protected:
  FullDisks() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(read_text(work() / directory / "summary.json"), nullptr, false);
  }
  /// Runs the program on a separate disk and moves its files to work()/kept at the end.
  /// \return exit status; -1 where the system does not permit making disks
  int run_on_disk(int kilobytes, const std::string& words) const {
    const std::string disk = (temporary_ / "disk").string(), kept = (work() / "kept").string();
    fs::create_directories(disk);
    fs::remove_all(kept);
    write_text(work() / "on_disk.sh",
               fmt::format("mount -t tmpfs -o size={}k none {} || exit 99\n"
                           "cd {}\n{} {} --out {}/r --quiet 2> {}/messages\n"
                           "status=$?\ncp -a {} {}\nexit $status\n",
                           kilobytes, disk, work().string(), PERILINK_PROGRAM, words, disk,
                           work().string(), disk, kept));
    const std::string command = fmt::format("unshare -rm sh {}/on_disk.sh 2> {}/unshare.err",
                                            work().string(), work().string());
    const int status = std::system(command.c_str());
    return fs::exists(kept) ? WEXITSTATUS(status) : -1;
  }

  TemporaryDirectory temporary_;
};

std::string damage_case() {
  std::string text = small_ghost_case;
  text.replace(text.find("fields_at = [10, 20]"), 20, "fields_every = 5");
  return text;
}

void expect_failed(const nlohmann::json& summary) {
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_NE(summary["peak_load"], 0.0);
  EXPECT_GT(summary["steps"].get<int>(), 0);
  EXPECT_THAT(summary["reason"].get<std::string>(), HasSubstr("cannot be written"));
}

/// Field files grow with the broken bonds: at the size of the one of ten breaks there is no room
/// for the next.
TEST_F(FullDisks, ARunThatCannotWriteAFieldTellsWhatItFound) {
  write_text(work() / "damage.toml", damage_case());
  ASSERT_EQ(run_program(work(), {"run", "damage.toml", "--out", "free"}).exit_status, 0);
  const auto size = fs::file_size(work() / "free/fields_000011.vtu");
  const ProcessEnd end =
      run_program(work(), {"run", "damage.toml", "--out", "r"}, {{RLIMIT_FSIZE, size}});
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.err, HasSubstr("fields_000016.vtu: cannot be written: File too large"));
  EXPECT_EQ(expect_whole_files(work() / "r"), 0) << "a temporary is left";
  expect_failed(summary("r"));
  EXPECT_EQ(summary("r")["steps"], expect_whole_table(work() / "r/history.csv"));
  EXPECT_EQ(summary("r")["peak_load"], summary("free")["peak_load"]) << "of the first rows";
  EXPECT_EQ(run_program(work(), {"plot", "r"}).exit_status, 0);
}

TEST_F(FullDisks, ARunThatCannotWriteItsHistoryTellsWhatItFound) {
  std::string text = lattice_strip_case();
  text.replace(text.find("rows = 100"), 10, "rows = 1000");
  write_text(work() / "strip.toml", text);
  const rlim_t size = 64 * 1024;
  const ProcessEnd end =
      run_program(work(), {"run", "strip.toml", "--out", "r"}, {{RLIMIT_FSIZE, size}});
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.err, HasSubstr("history.csv: cannot be written: File too large"));
  EXPECT_EQ(expect_whole_files(work() / "r"), 0);
  expect_failed(summary("r"));
  const int rows = expect_whole_table(work() / "r/history.csv");
  EXPECT_GT(rows, 100);
  EXPECT_GE(summary("r")["steps"].get<int>(), rows);
  EXPECT_LE(fs::file_size(work() / "r/history.csv"), size);
}

/// Other faults than a full disk: of the files that are open together the last ones are refused.
TEST_F(FullDisks, ARunWhoseFilesCannotBeOpenedDoesNotSeemToGoOn) {
  write_text(work() / "damage.toml", damage_case());
  bool told = false;
  for (rlim_t most = 4; most < 12; ++most) {
    const ProcessEnd end = run_program(work(), {"run", "damage.toml", "--out", "r", "--force"},
                                       {{RLIMIT_NOFILE, most}});
    if (end.exit_status == 0 || !fs::exists(work() / "r/summary.json")) continue;
    if (end.err.find("summary.json: cannot be written") != std::string::npos) continue;
    EXPECT_EQ(summary("r")["status"], "failed") << most << ": " << end.err;
    told = true;
  }
  EXPECT_TRUE(told);
}

/// Where standard output is a file.
TEST_F(FullDisks, WhatCannotBePrintedIsNoSuccess) {
  write_text(work() / "damage.toml", damage_case());
  const ProcessEnd end = run_program(work(), {"check", "damage.toml"}, {{RLIMIT_FSIZE, 1000}});
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_THAT(end.err, HasSubstr("standard output cannot be written: File too large"));
}

TEST_F(FullDisks, EveryFileIsWholeWhereverTheRoomEnds) {
  write_text(work() / "damage.toml", damage_case());
  bool ran_out = false, told = false;
  for (const int kilobytes : {4, 8, 12, 16, 24, 32, 40, 56, 80, 120}) {
    const int status = run_on_disk(kilobytes, "run damage.toml");
    if (status < 0) GTEST_SKIP() << "no disk: " << read_text(work() / "unshare.err");
    ASSERT_TRUE(status == 0 || status == 3) << kilobytes << ": " << status;
    ran_out = ran_out || status == 3;
    const std::string messages = read_text(work() / "messages");
    EXPECT_EQ(messages.find("No space left") != std::string::npos, status == 3) << messages;
    if (!fs::exists(work() / "kept/r")) continue;
    EXPECT_EQ(expect_whole_files(work() / "kept/r"), 0) << kilobytes;
    const nlohmann::json json = summary("kept/r");
    if (status != 3 || !fs::exists(work() / "kept/r/fields_000001.vtu")) continue;
    expect_failed(json);
    told = true;
  }
  EXPECT_TRUE(ran_out && told);
}

TEST_F(FullDisks, AStudyKeepsItsTable) {
  write_text(work() / "bar.toml", tension_strip_case);
  write_text(work() / "study.toml",
             "case = \"bar.toml\"\n[vary]\nspacing = [0.25, 0.2, 0.125]\nhorizon_ratio = [2]\n"
             "surface = [\"none\"]\n[error]\nquantity = \"strain_energy\"\nreference = 0.04\n");
  for (const int kilobytes : {8, 12, 16}) {
    const int status = run_on_disk(kilobytes, "converge study.toml");
    if (status < 0) GTEST_SKIP() << "no disk: " << read_text(work() / "unshare.err");
    EXPECT_EQ(status, 3) << kilobytes;
    EXPECT_EQ(expect_whole_files(work() / "kept/r"), 0) << kilobytes;
  }
  EXPECT_GT(expect_whole_table(work() / "kept/r/table.csv"), 0);
}

}  // namespace
}  // namespace perilink::test
