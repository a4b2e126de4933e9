#include "results/result_directory.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "support/temporary_directory.hpp"

namespace perilink {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(ResultDirectory, IsNamedAfterTheCase) {
  EXPECT_EQ(default_result_directory("meshes/block.v2.toml"), fs::path("results/block.v2"));
  EXPECT_EQ(default_result_directory("beam"), fs::path("results/beam"));
}

TEST(ResultDirectory, SaysWhatADirectoryWithoutARunHolds) {
  for (const auto& [name, text] :
       {std::pair("study.toml", "a study"), std::pair("compare.csv", "a comparison"),
        std::pair("scan.csv", "a scan"), std::pair("notes.txt", "perilink run writes one")}) {
    const test::TemporaryDirectory work;
    test::write_text(work / name, "");
    try {
      require_result(work.path());
      ADD_FAILURE() << name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
}

TEST(ResultDirectory, IsMadeWithItsParents) {
  const test::TemporaryDirectory work;
  ResultDirectory(work / "a/b/c", OldResults::refused);
  EXPECT_TRUE(fs::is_directory(work / "a/b/c"));
  ResultDirectory(work / "a/b/c", OldResults::refused);  // empty: nothing to lose
}

TEST(ResultDirectory, RefusesAnEarlierResultAndLeavesItAlone) {
  for (const char* name :
       {"case.toml", "history.csv", "timing.csv", "summary.json", "fields.pvd", "log.txt",
        "load_displacement.svg", "fields_000010.vtu", "fields_000010.svg", "animation.png"}) {
    const test::TemporaryDirectory work;
    test::write_text(work / name, "old");
    try {
      ResultDirectory(work.path(), OldResults::refused);
      ADD_FAILURE() << name << " was not seen";
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
    EXPECT_EQ(test::read_text(work / name), "old");
  }
}

TEST(ResultDirectory, ForceRemovesTheFilesOfARunAndOnlyThose) {
  const test::TemporaryDirectory work;
  const std::set<std::string> own = {"notes.txt", "fields_old.csv", "history.csv.bak", "my.vtu",
                                     "fields.txt"};
  for (const std::string& name : own) test::write_text(work / name, "mine");
  for (const char* name : {"case.toml", "history.csv", "fields_000010.vtu", "fields_000010.png"}) {
    test::write_text(work / name, "old");
  }
  fs::create_directories(work / "sub");
  test::write_text(work / "sub/history.csv", "of another run");
  ResultDirectory(work.path(), OldResults::removed);
  std::set<std::string> left = own;
  left.insert("sub");
  EXPECT_EQ(names_in(work.path()), left);
  EXPECT_EQ(test::read_text(work / "sub/history.csv"), "of another run");
}

TEST(ResultDirectory, ForceRemovesWhatAKilledRunLeftHalfWritten) {
  const test::TemporaryDirectory work;
  const std::set<std::string> own = {"notes.txt.0123abcd.part", "fields.pvd.part"};
  for (const std::string& name : own) test::write_text(work / name, "mine");
  for (const char* name : {"fields_000010.vtu.0123abcd.part", "summary.json.00000000.part"}) {
    test::write_text(work / name, "half");
  }
  ResultDirectory(work.path(), OldResults::removed);
  EXPECT_EQ(names_in(work.path()), own);
}

/// A run that is killed while it removes them leaves no list of files that are gone.
TEST(ResultDirectory, WhatSpeaksOfOtherFilesGoesFirst) {
  const test::TemporaryDirectory work;
  for (const char* name : {"case.toml", "fields.pvd", "fields_000010.vtu", "history.csv", "log.txt",
                           "summary.json", "bars_000010.csv"}) {
    test::write_text(work / name, "old");
  }
  const std::vector<fs::path> order = refuse_old_results(work.path(), true);
  ASSERT_EQ(order.size(), 7u);
  EXPECT_EQ(order[0].filename(), "summary.json");
  EXPECT_EQ(order[1].filename(), "fields.pvd");
}

TEST(ResultDirectory, IsOneRunsAtATime) {
  const test::TemporaryDirectory work;
  fs::create_directory_symlink("a", work / "link");
  {
    const ResultDirectory first(work / "a", OldResults::refused);
    for (const char* name : {"a", "link"}) {
      try {
        ResultDirectory(work / name, OldResults::removed);
        ADD_FAILURE() << "a second run had the directory";
      } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find("another run is writing"), std::string::npos);
      }
    }
    const ResultDirectory other(work / "b", OldResults::refused);
  }
  ResultDirectory(work / "link", OldResults::refused);
  EXPECT_TRUE(fs::is_empty(work / "a")) << "a lock leaves nothing behind";
}

TEST(ResultDirectory, LinksInItGoTheirTargetsStay) {
  const test::TemporaryDirectory work;
  test::write_text(work / "mine", "mine");
  fs::create_directories(work / "r");
  for (const char* name : {"history.csv", "log.txt", "summary.json", "table.csv"}) {
    fs::create_symlink("../mine", work / "r" / name);
  }
  EXPECT_THROW(ResultDirectory(work / "r", OldResults::refused), FileError);
  ResultDirectory(work / "r", OldResults::removed);
  EXPECT_TRUE(fs::is_empty(work / "r"));
  EXPECT_EQ(test::read_text(work / "mine"), "mine");
}

TEST(ResultDirectory, RefusesAFileInItsPlace) {
  const test::TemporaryDirectory work;
  test::write_text(work / "results", "a file");
  EXPECT_THROW(ResultDirectory(work / "results", OldResults::removed), FileError);
  EXPECT_THROW(ResultDirectory(work / "results/deeper", OldResults::removed), FileError);
  EXPECT_EQ(test::read_text(work / "results"), "a file");
}

}  // namespace
}  // namespace perilink
