// Nothing that the project publishes depends on, or speaks of, the machine it was written on.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string>

#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

bool is_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(4096, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  return start.find('\0') == std::string::npos;
}

TEST(Text, NoFileNamesThePlacesOfOneMachine) {
  // Written in pieces, so that this file passes its own test.
  const std::regex place(
      "/wor"
      "k/|/tm"
      "p/|/hom"
      "e/|(^|[^A-Za-z0-9_/-])(\\.\\./)?share"
      "d/");
  for (const auto& file : tracked_files()) {
    if (!is_text(file)) continue;
    int number = 0;
    for (const std::string& line : read_lines(file)) {
      ++number;
      EXPECT_FALSE(std::regex_search(line, place)) << shown(file) << ":" << number << ": " << line;
    }
  }
}

TEST(Text, SourcesUseUnixLineEndsAndNoTabs) {
  for (const char* folder : {"src", "tests", "verification"}) {
    for (const auto& file : cpp_files(folder)) {
      int number = 0;
      for (const std::string& line : read_lines(file)) {
        ++number;
        EXPECT_EQ(line.find_first_of("\t\r"), std::string::npos) << shown(file) << ":" << number;
      }
    }
  }
}

/// ColumnLimit of .clang-format.
std::ptrdiff_t column_limit() {
  const std::regex entry("ColumnLimit: *([0-9]+)");
  std::smatch found;
  for (const std::string& line : read_lines(project_root() / ".clang-format")) {
    if (std::regex_match(line, found, entry)) return std::stol(found[1]);
  }
  throw std::runtime_error(".clang-format says no ColumnLimit");
}

TEST(Text, LinesOfSourcesEndAtTheColumnLimit) {
  const std::ptrdiff_t limit = column_limit();
  for (const char* folder : {"src", "tests", "verification"}) {
    for (const auto& file : cpp_files(folder)) {
      int number = 0;
      for (const std::string& line : read_lines(file)) {
        ++number;
        // Characters of UTF-8 begin with every byte but those of the form 10xxxxxx.
        const auto columns = std::count_if(line.begin(), line.end(), [](char byte) {
          return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
        });
        EXPECT_LE(columns, limit) << shown(file) << ":" << number;
      }
    }
  }
}

}  // namespace
}  // namespace perilink::quality
