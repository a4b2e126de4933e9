// perilink compare from outside: messages, exit statuses, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "support/process.hpp"
#include "support/program_cases.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;

class Comparisons : public testing::Test {
 protected:
  Comparisons() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  ProcessEnd run(const std::vector<std::string>& arguments) const {
    return run_program(work(), arguments);
  }
  /// Runs the small block into results/`name`, as it is or with another line in place of one.
  void make_result(const std::string& name, const std::string& line = "",
                   const std::string& other = "") const {
    std::string text = small_ghost_case;
    if (!line.empty()) text.replace(text.find(line), line.size(), other);
    write_text(work() / (name + ".toml"), text);
    const ProcessEnd end = run({"run", name + ".toml", "--quiet"});
    ASSERT_EQ(end.exit_status, 0) << end.err;
  }
  std::string file(const std::string& name) const { return read_text(work() / name); }
  std::set<std::string> names(const std::string& directory) const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(work() / directory)) {
      found.insert(entry.path().filename().string());
    }
    return found;
  }
  /// Fields after the name of a row of results/a_vs_b/compare.csv that holds no quotes.
  std::vector<std::string> row(const std::string& quantity) const {
    std::istringstream lines(file("results/a_vs_b/compare.csv"));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with(quantity + ",")) continue;
      std::vector<std::string> fields;
      std::istringstream rest(line.substr(quantity.size() + 1));
      for (std::string field; std::getline(rest, field, ',');) fields.push_back(field);
      return fields;
    }
    return {};
  }

  TemporaryDirectory temporary_;
};

TEST_F(Comparisons, ARunIsLikeItself) {
  make_result("a");
  make_result("b");
  const ProcessEnd end = run({"compare", "results/a", "results/b"});
  EXPECT_EQ(end.exit_status, 0);
  EXPECT_EQ(end.err, "");
  EXPECT_EQ(names("results/a_vs_b"), (std::set<std::string>{"compare.csv", "compare.svg"}));
  EXPECT_THAT(end.out, HasSubstr("A  results/a: Small block (completed)\n"));
  EXPECT_THAT(end.out, HasSubstr("comparison in results/a_vs_b\n"));
  EXPECT_EQ(row("peak_load").at(3), "0");
  EXPECT_EQ(row("load_distance").at(4), "0");
  EXPECT_EQ(row("broken_bonds").at(1), "30");
  EXPECT_EQ(row("broken_bonds").at(2), "30");
  EXPECT_THAT(file("results/a_vs_b/compare.svg"), HasSubstr("Small block"));
}

TEST_F(Comparisons, TheTableHasTheNumbersOfTheRuns) {
  make_result("a");
  make_result("b", "youngs_modulus = 3604.0", "youngs_modulus = 3000.0");
  const ProcessEnd end = run({"compare", "results/a/", "results/b"});
  ASSERT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, ContainsRegex("peak load \\(kip\\) +[0-9.]+ +[0-9.]+ +[-+][0-9.]+ %"));
  // Stretches at failure are sqrt(G / E), loads E times that: about sqrt(3000/3604) of the first.
  const double peak_a = std::stod(row("peak_load").at(1)),
               peak_b = std::stod(row("peak_load").at(2));
  EXPECT_LT(peak_b, peak_a);
  EXPECT_NEAR(std::stod(row("peak_load").at(3)), 100.0 * (peak_b - peak_a) / peak_a, 1e-9);
  EXPECT_THAT(file("results/a/summary.json"),
              HasSubstr("\"peak_load\": " + row("peak_load").at(1)));
  EXPECT_THAT(file("results/b/summary.json"),
              HasSubstr("\"peak_load\": " + row("peak_load").at(2)));
  EXPECT_EQ(row("peak_load").at(0), "kip");
}

TEST_F(Comparisons, ElasticAndKilledRunsAreCompared) {
  make_result("a");
  make_result("b", "[analysis]", "[analysis]\ntype = \"elastic\"");
  fs::remove(work() / "results/a/summary.json");
  const ProcessEnd end = run({"compare", "results/a", "results/b"});
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("note: A: unfinished or killed: no summary.json"));
  EXPECT_EQ(row("cracked_volume").at(2), "0");
  EXPECT_EQ(row("particles").at(1), "");
}

TEST_F(Comparisons, EarlierComparisonsAreKeptUnlessForced) {
  make_result("a");
  const std::vector<std::string> words = {"compare", "results/a", "results/a", "--out",
                                          "results/a"};
  const std::set<std::string> before = names("results/a");
  ASSERT_EQ(run(words).exit_status, 0) << "a comparison may be written into a result";
  const ProcessEnd refused = run(words);
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_THAT(refused.err, HasSubstr("results/a: holds an earlier comparison (found compare.csv)"));
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  std::vector<std::string> forced = words;
  forced.insert(forced.end(), {"--force", "--quiet"});
  const ProcessEnd end = run(forced);
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(end.out, "");
  std::set<std::string> expected = before;
  expected.insert({"compare.csv", "compare.svg"});
  EXPECT_EQ(names("results/a"), expected);
}

TEST_F(Comparisons, WhatIsNoResultIsRefused) {
  make_result("a");
  fs::create_directories(work() / "empty");
  fs::create_directories(work() / "study");
  fs::create_directories(work() / "started");
  write_text(work() / "study/study.toml", "");
  write_text(work() / "started/history.csv", "step,load,displacement\n");
  const std::map<std::string, std::string> messages = {
      {"nowhere", "nowhere: there is no such directory"},
      {"a.toml",
       "a.toml: is not a directory; give the directory of a result of "
       "perilink run"},
      {"empty", "empty: is not a result of a run: it has no history.csv"},
      {"study", "it holds a study of perilink converge"},
      {"started", "started/history.csv: has no row"}};
  for (const auto& [directory, message] : messages) {
    for (const bool first : {true, false}) {
      const ProcessEnd end = first ? run({"compare", directory, "results/a"})
                                   : run({"compare", "results/a", directory});
      EXPECT_EQ(end.exit_status, 2) << directory;
      EXPECT_THAT(end.err, HasSubstr(message));
      EXPECT_EQ(end.out, "");
    }
  }
  EXPECT_EQ(names("results"), std::set<std::string>{"a"}) << "a refused comparison left files";
  const ProcessEnd no_place = run({"compare", "results/a", "results/a", "--out", "a.toml"});
  EXPECT_EQ(no_place.exit_status, 2);
  EXPECT_THAT(no_place.err, HasSubstr("a.toml: exists and is not a directory"));
}

}  // namespace
}  // namespace perilink::test
