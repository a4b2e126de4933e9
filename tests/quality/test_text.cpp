// Texts of the project: they speak of no machine, their lines are not too long, and their comments
// begin with words that stand by themselves.

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

/// Where the comment of a line begins: "//", "///" or "///<" outside texts; npos: nowhere.
std::size_t comment_of(const std::string& line) {
  bool in_text = false;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (line[k] == '"' && (k == 0 || line[k - 1] != '\\')) in_text = !in_text;
    if (!in_text && line[k] == '/' && line[k + 1] == '/') return k;
  }
  return std::string::npos;
}

/// Such a comment makes sense only together with the name beside which it stands.
TEST(Text, NoCommentBeginsWithOf) {
  const std::regex sentence(R"(//[/<]* +(Of|\\param +\w+ +of)\b.*)");
  const std::regex fragment(R"(//[/<]* +of\b.*)");
  for (const char* folder : {"src", "tests", "verification"}) {
    for (const auto& file : cpp_files(folder)) {
      std::string before;
      int number = 0;
      for (const std::string& line : read_lines(file)) {
        ++number;
        const std::size_t start = comment_of(line);
        const std::string comment = start == std::string::npos ? "" : line.substr(start);
        const bool goes_on = !before.empty() && line.find_first_not_of(' ') == start;
        EXPECT_FALSE(std::regex_match(comment, sentence) ||
                     (!goes_on && std::regex_match(comment, fragment)))
            << shown(file) << ":" << number << ": " << comment;
        before = comment;
      }
    }
  }
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
