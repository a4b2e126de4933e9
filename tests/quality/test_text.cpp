// Texts of the project name no machine, keep to the column limit and use the words of the field.

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

/// A docstring is true and clear without the declaration before it, and words are those of the
/// field.
TEST(Text, CommentsStandAlone) {
  const std::regex opening(R"(//[/<]* +(The same|That of|Those of|What|Of)\b.*)");
  const std::regex coined(  // saw-teeth are the field's
      R"(.*(^|[^-A-Za-z_])(tooth|teeth|dozing|dozes?|avalanches?|soft fields?|alike|borne|)"
      R"(lets? go|hopeless|restless|likeliest|carriers?|glued|verdicts?)\b.*)");
  for (const auto& file : cpp_files("src")) {
    int number = 0;
    for (const std::string& line : read_lines(file)) {
      ++number;
      const std::size_t start = comment_of(line);
      if (start == std::string::npos) continue;
      const std::string comment = line.substr(start);
      EXPECT_FALSE(std::regex_match(comment, opening))
          << shown(file) << ":" << number << ": " << comment;
      EXPECT_FALSE(std::regex_match(comment, coined))
          << shown(file) << ":" << number << ": " << comment;
    }
  }
}

/// Characters of UTF-8: they begin with every byte but those of the form 10xxxxxx.
std::ptrdiff_t columns(const std::string& line) {
  return std::count_if(line.begin(), line.end(),
                       [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; });
}

TEST(Text, LinesOfSourcesEndAtTheColumnLimit) {
  const std::ptrdiff_t limit = column_limit();
  for (const char* folder : {"src", "tests", "verification"}) {
    for (const auto& file : cpp_files(folder)) {
      int number = 0;
      for (const std::string& line : read_lines(file)) {
        ++number;
        EXPECT_LE(columns(line), limit) << shown(file) << ":" << number;
      }
    }
  }
}

/// Walks through the lines of a Markdown file and knows which of them can be wrapped: not tables,
/// code, formulas that stand alone, pictures and headings, nor a line of one word.
class MarkdownLines {
 public:
  bool can_wrap(const std::string& line) {
    static const std::regex fence("^ *(```|~~~).*"), one_word(" *[^ ]*");
    static const std::regex stays("^( {4}|\\||!\\[|#|<).*");
    if (std::regex_match(line, fence)) {
      in_code_ = !in_code_;
      return false;
    }
    if (in_code_) return false;
    const std::size_t first = line.find("$$");
    if (first != std::string::npos) {
      // One that opens a formula and leaves it open, or closes it.
      if (line.find("$$", first + 2) == std::string::npos) in_formula_ = !in_formula_;
      return false;
    }
    return !in_formula_ && !std::regex_match(line, stays) && !std::regex_match(line, one_word);
  }

  /// Whether code or a formula has begun and not ended.
  bool is_open() const { return in_code_ || in_formula_; }

 private:
  bool in_code_ = false;
  bool in_formula_ = false;
};

TEST(Text, MarkdownWrapsAtTheColumnLimit) {
  const std::ptrdiff_t limit = column_limit();
  for (const auto& file : tracked_files()) {
    if (file.extension() != ".md") continue;
    MarkdownLines lines;
    int number = 0;
    for (const std::string& line : read_lines(file)) {
      ++number;
      EXPECT_TRUE(!lines.can_wrap(line) || columns(line) <= limit)
          << shown(file) << ":" << number << ": " << line;
    }
    EXPECT_FALSE(lines.is_open()) << shown(file) << " leaves code or a formula open";
  }
}

}  // namespace
}  // namespace perilink::quality
