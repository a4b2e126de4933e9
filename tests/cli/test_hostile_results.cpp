// Damaged or malicious results and inputs, and directories used by two runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>
#include <pugixml.hpp>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/whole_files.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class HostileResults : public testing::Test {
 protected:
  HostileResults() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  void make_result() const {
    write_text(work() / "small.toml", small_ghost_case);
    const ProcessEnd end = run({"run", "small.toml", "--out", "r", "--quiet"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read_text(work() / "r" / name);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << name << ": " << from;
    write_text(work() / "r" / name, text.replace(at, from.size(), to));
  }

  TemporaryDirectory temporary_;
};

TEST_F(HostileResults, DamagedHistoriesAreDrawnAndComparedByNobody) {
  make_result();
  const std::string good = read_text(work() / "r/history.csv");
  const std::size_t row = good.find("\n5,") + 1, field = good.find(',', row) + 1;
  const std::size_t field_end = good.find(',', field);
  for (const std::string value : {"inf", "nan", "", "1e400", "0x10", "4;5", "-3", "2.5"}) {
    std::string text = good;
    write_text(work() / "r/history.csv", text.replace(field, field_end - field, value));
    for (const auto& words : {std::vector<std::string>{"plot", "r"}, {"compare", "r", "r"}}) {
      const ProcessEnd end = run(words);
      EXPECT_EQ(end.exit_status, 2) << words[0] << " took " << value;
      EXPECT_THAT(end.err, HasSubstr("r/history.csv:"));
      EXPECT_THAT(end.err, HasSubstr("broken_bonds"));
    }
  }
  EXPECT_FALSE(fs::exists(work() / "r/load_displacement.svg"));
}

TEST_F(HostileResults, ALastRowThatIsCutOffIsLeftOutWithAWord) {
  make_result();
  const std::string good = read_text(work() / "r/history.csv");
  // In the midst of its last number: what is left could pass for a row.
  write_text(work() / "r/history.csv", good.substr(0, good.size() - 2));
  for (const auto& words : {std::vector<std::string>{"plot", "r"}, {"compare", "r", "r"}}) {
    const ProcessEnd end = run(words);
    EXPECT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out + end.err, HasSubstr("ends within a row, which is ignored"));
  }
}

TEST_F(HostileResults, DamagedSummariesAreRefusedWithWhatToDo) {
  make_result();
  for (const char* text :
       {"", "{\"title\": \"cut o", "[]", "{}", "{\"status\": \"completed\", \"title\": 1}",
        "{\"status\": \"completed\", \"peak_load\": \"much\"}",
        "{\"status\": \"completed\", \"first_peak_load\": {}}"}) {
    write_text(work() / "r/summary.json", text);
    for (const auto& words : {std::vector<std::string>{"plot", "r"}, {"compare", "r", "r"}}) {
      const ProcessEnd end = run(words);
      EXPECT_EQ(end.exit_status, 2) << text;
      EXPECT_THAT(end.err, HasSubstr("r/summary.json: "));
      EXPECT_THAT(end.err, HasSubstr("delete it"));
    }
  }
  fs::remove(work() / "r/summary.json");
  EXPECT_EQ(run({"plot", "r"}).exit_status, 0);
}

TEST_F(HostileResults, EscapeCodesReachNoTerminalAndNoPicture) {
  make_result();
  change("summary.json", "Small block", "\\u001b]0;owned\\u0007=1+2\\u009b31m");
  change("summary.json", "30 bonds are broken", "\\u001b[2J");
  change("summary.json", "\"completed\"", "\"failed\"");
  for (const auto& words : {std::vector<std::string>{"plot", "r"}, {"compare", "r", "r"}}) {
    const ProcessEnd end = run(words);
    EXPECT_EQ(end.exit_status, 0) << end.err;
    EXPECT_THAT(end.out + end.err, Not(HasSubstr("\x1b")));
    EXPECT_THAT(end.out + end.err, Not(HasSubstr("\xc2\x9b")));
  }
  pugi::xml_document picture;
  const std::string svg = read_text(work() / "r/load_displacement.svg");
  EXPECT_TRUE(picture.load_string(svg.c_str()));
  EXPECT_THAT(svg, HasSubstr("\\x1b]0;owned"));
  EXPECT_THAT(svg, Not(HasSubstr("\x1b")));
  change("summary.json", "\\u001b]0;owned\\u0007", "");
  ASSERT_EQ(run({"compare", "r", "r", "--force"}).exit_status, 0);
  EXPECT_THAT(read_text(work() / "results/r_vs_r/compare.csv"), HasSubstr("title,,\"'=1+2"));
}

TEST_F(HostileResults, SeriesOfFieldsStayInTheirFolder) {
  make_result();
  fs::copy_file(work() / "r/fields_000001.vtu", work() / "outside.vtu");
  const std::string outside = (work() / "outside.vtu").string();
  for (const std::string& file : {std::string("../outside.vtu"), outside}) {
    const std::string good = read_text(work() / "r/fields.pvd");
    change("fields.pvd", "fields_000001.vtu", file);
    const ProcessEnd end = run({"plot", "r"});
    EXPECT_EQ(end.exit_status, 2) << file;
    EXPECT_THAT(end.err, HasSubstr("only files of the same folder are read"));
    write_text(work() / "r/fields.pvd", good);
  }
}

TEST_F(HostileResults, ScalesAreFiniteNumbersAboveZero) {
  make_result();
  for (const char* scale : {"nan", "inf", "-inf", "0", "-1", "1e400", "1e13", "x", ""}) {
    const ProcessEnd end = run({"plot", "r", "--scale", scale});
    EXPECT_EQ(end.exit_status, 2) << scale;
    EXPECT_THAT(end.err, HasSubstr("give a number above 0")) << scale;
  }
  EXPECT_EQ(run({"plot", "r", "--scale", "2.5e1"}).exit_status, 0);
  for (const char* threads : {"nan", "0", "-1", "1e99", "1.5"}) {
    EXPECT_EQ(run({"run", "small.toml", "--threads", threads}).exit_status, 2) << threads;
  }
}

TEST_F(HostileResults, LinksThatSomebodyLaidAreNotFollowed) {
  make_result();
  write_text(work() / "victim", "mine");
  ASSERT_EQ(run({"compare", "r", "r", "--out", "c"}).exit_status, 0);
  ASSERT_EQ(run({"plot", "r"}).exit_status, 0);
  for (const char* name : {"c/compare.csv", "c/compare.csv.part", "c/compare.svg", "r/history.csv",
                           "r/summary.json.part", "r/load_displacement.svg", "r/log.txt",
                           "r/load_displacement.svg.part", "r/fields_000001.vtu.part"}) {
    fs::remove(work() / name);
    fs::create_symlink(work() / "victim", work() / name);
  }
  EXPECT_EQ(run({"compare", "r", "r", "--out", "c", "--force"}).exit_status, 2) << "no history";
  EXPECT_EQ(run({"run", "small.toml", "--out", "r"}).exit_status, 2);
  EXPECT_EQ(run({"run", "small.toml", "--out", "r", "--force"}).exit_status, 0);
  EXPECT_EQ(run({"compare", "r", "r", "--out", "c", "--force"}).exit_status, 0);
  EXPECT_EQ(run({"plot", "r"}).exit_status, 0);
  EXPECT_EQ(read_text(work() / "victim"), "mine");
}

TEST_F(HostileResults, PipesAndFoldersAreNotWaitedFor) {
  make_result();
  ASSERT_EQ(mkfifo((work() / "pipe.toml").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((work() / "pipe.msh").c_str(), 0600), 0);
  std::string text = small_ghost_case;
  text.replace(text.find("spacing = 12.5\nhorizon = 31.45\n"), 31,
               "mesh = \"pipe.msh\"\nhorizon = 31.45\n");
  text.replace(text.find("surface = \"ghost\"\n"), 18, "");
  write_text(work() / "mesh.toml", text);
  write_text(work() / "study.toml",
             "case = \"pipe.toml\"\n[vary]\nspacing = [1, 2]\n"
             "[error]\nquantity = \"peak_load\"\nreference = 1\n");
  fs::remove(work() / "r/history.csv");
  ASSERT_EQ(mkfifo((work() / "r/history.csv").c_str(), 0600), 0);
  const std::vector<std::vector<std::string>> all = {
      {"check", "pipe.toml"}, {"run", "pipe.toml"},      {"run", "mesh.toml"},
      {"plot", "r"},          {"converge", "pipe.toml"}, {"converge", "study.toml"}};
  for (const std::vector<std::string>& words : all) {
    const ProcessEnd end = run(words);
    EXPECT_EQ(end.exit_status, 2) << words[0] << " " << words[1];
    EXPECT_THAT(end.err, HasSubstr("is a named pipe, not a file"));
  }
  EXPECT_THAT(run({"check", "."}).err, HasSubstr("is a directory, not a file"));
  EXPECT_THAT(run({"check", "/dev/zero"}).err, HasSubstr("is a device, not a file"));
}

TEST_F(HostileResults, PathsThatSteerATerminalAreRefused) {
  const ProcessEnd end = run({"run", "a\x1b[2J.toml"});
  EXPECT_EQ(end.exit_status, 2);
  EXPECT_THAT(end.err, Not(HasSubstr("\x1b")));
  EXPECT_THAT(run({"run", "--\x1b[2J"}).err, Not(HasSubstr("\x1b")));
}

TEST_F(HostileResults, TwoRunsThatStartAtOnceDoNotShareADirectory) {
  write_text(work() / "small.toml", small_ghost_case);
  const std::vector<std::string> words = {"run", "small.toml", "--out", "r", "--force"};
  fs::create_directories(work() / "other");
  for (int k = 0; k < 5; ++k) {
    ProgramProcess first(work(), words);
    ProgramProcess second(work() / "other", {"run", "../small.toml", "--out", "../r"});
    const ProcessEnd a = first.wait(), b = second.wait();
    EXPECT_TRUE(a.exit_status == 0 || b.exit_status == 0) << a.err << b.err;
    EXPECT_EQ(expect_whole_files(work() / "r"), 0);
    EXPECT_EQ(expect_whole_table(work() / "r/history.csv"), 31);
    fs::remove_all(work() / "r");
  }
}

TEST_F(HostileResults, ADirectoryIsFreeAgainWhenItsRunWasKilled) {
  write_text(work() / "long.toml", hexagonal_case(86, 1000000));
  write_text(work() / "small.toml", small_ghost_case);
  ProgramProcess process(work(), {"run", "long.toml", "--out", "r", "--threads", "1"});
  ASSERT_TRUE(process.wait_until([&] { return fs::exists(work() / "r/fields.pvd"); }));
  const std::vector<std::string> words = {"run", "small.toml", "--out", "r", "--force"};
  const std::string before = read_text(work() / "r/case.toml");
  fs::create_directories(work() / "other");
  const ProcessEnd refused =
      run_program(work() / "other", {"run", "../small.toml", "--out", "../r", "--force"});
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_THAT(refused.err, HasSubstr("another run is writing its results there"));
  EXPECT_EQ(read_text(work() / "r/case.toml"), before);
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  const ProcessEnd end = run_program(work(), words);
  EXPECT_EQ(end.exit_status, 0) << end.err;
}

}  // namespace
}  // namespace perilink::test
