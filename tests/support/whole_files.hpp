#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "io/fields/vtu.hpp"
#include "support/temporary_directory.hpp"

namespace perilink::test {

/// Returns the number of commas outside quotes.
inline int separators(const std::string& line) {
  int found = 0;
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    found += c == ',' && !quoted ? 1 : 0;
  }
  return found;
}

/// Termination of the program that wrote the files. A kill can end a write of the kernel between
/// two memory pages, so only the last row may be incomplete.
enum class Ended { by_itself, by_a_kill };

/// Expects a header and rows with as many complete fields. \return number of rows
inline int expect_whole_table(const std::filesystem::path& path, Ended ended = Ended::by_itself) {
  std::string text = read_text(path);
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  if (ended == Ended::by_a_kill && text.size() % page == 0) text.erase(text.rfind('\n') + 1);
  EXPECT_TRUE(text.ends_with('\n')) << path << ": the last row is cut";
  std::istringstream lines(text);
  int rows = -1, fields = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    if (rows < 0) fields = separators(line);
    EXPECT_EQ(separators(line), fields) << path << ": " << line;
  }
  EXPECT_GE(rows, 0) << path << ": no header";
  return rows;
}

/// Expects that all files of a results directory are complete after any termination, except
/// temporary files (*.part). \return number of temporary files
inline int expect_whole_files(const std::filesystem::path& directory,
                              Ended ended = Ended::by_itself) {
  int temporaries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::filesystem::path& path = entry.path();
    const std::string name = path.filename().string(), end = path.extension().string();
    if (end == ".part") {
      ++temporaries;
      continue;
    }
    if (end == ".vtu") {
      EXPECT_NO_THROW(read_vtu(path.string())) << path;
    } else if (end == ".pvd") {
      for (const PvdEntry& field : read_pvd(path.string())) {
        EXPECT_TRUE(std::filesystem::exists(directory / field.file)) << field.file;
      }
    } else if (end == ".json") {
      EXPECT_TRUE(nlohmann::json::parse(read_text(path), nullptr, false).is_object()) << path;
    } else if (end == ".csv") {
      expect_whole_table(path, ended);
    } else if (end == ".toml") {
      EXPECT_TRUE(read_text(path).ends_with('\n')) << path;
    } else if (end == ".svg") {
      EXPECT_TRUE(read_text(path).ends_with("</svg>\n")) << path;
    } else {
      EXPECT_EQ(name, "log.txt");
    }
  }
  return temporaries;
}

}  // namespace perilink::test
