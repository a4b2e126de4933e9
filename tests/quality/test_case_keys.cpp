// The user's page of the case file names every key that the reader accepts, with its range, words
// and default.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/case/case_keys.hpp"
#include "io/case/case_page.hpp"
#include "quality/source_tree.hpp"
#include "results/case_json_schema.hpp"

namespace perilink::quality {
namespace {

std::size_t heading_level(const std::string& line) {
  const std::size_t level = line.find_first_not_of('#');
  return level == std::string::npos ? 0 : level;
}

/// Text below the heading that names a table, down to the next heading of the same rank; all of the
/// page for the keys at the top of the file.
std::string section_of(const TableSchema& table, const std::vector<std::string>& page) {
  std::string text;
  std::size_t level = table.name.empty() ? page.size() : 0;
  for (const std::string& line : page) {
    const std::size_t here = heading_level(line);
    if (here > 0 && level > 0 && here <= level && !table.name.empty()) break;
    if (here > 0 && level == 0 && line.find(header_of(table)) != std::string::npos) level = here;
    if (level > 0) text += line + "\n";
  }
  return text;
}

TEST(CaseKeys, EveryKeyIsDocumented) {
  const auto page = read_lines(project_root() / "docs/case_file.md");
  for (const TableSchema& table : case_schema()) {
    const std::string section = section_of(table, page);
    EXPECT_FALSE(section.empty()) << "docs/case_file.md: no heading names " << header_of(table);
    for (const KeySchema& key : table.keys) {
      EXPECT_NE(section.find("`" + std::string(key.name)), std::string::npos)
          << "docs/case_file.md: " << header_of(table) << " lacks `" << key.name << "`";
    }
  }
}

/// Returns texts that the page's values of a key contain.
std::vector<std::string> expected_values(const Values& values) {
  std::vector<std::string> texts(values.words.begin(), values.words.end());
  const Range& range = values.range;
  if (values.kind == Values::Kind::integer) texts.emplace_back("integer");
  if (range.least == 0.0 && range.most == 1.0 && range.below) return {"in (0, 1)"};
  if (range.most < std::numeric_limits<int>::max()) {
    texts.push_back(fmt::format("{}{}{}",
                                range.above ? "> 0, up to " : fmt::format("{} to ", range.least),
                                range.below ? "below " : "", range.most));
  } else if (std::isfinite(range.least)) {
    texts.push_back(fmt::format("{} {}", range.above ? ">" : ">=", range.least));
  }
  return texts;
}

std::string shown(const TomlValue& value) {
  if (value.kind == TomlValue::Kind::text) return "\"" + value.text + "\"";
  if (value.kind == TomlValue::Kind::boolean) return value.boolean ? "true" : "false";
  return fmt::format("{}", value.number);
}

TEST(CaseKeys, ThePageHasRangesWordsAndDefaults) {
  int defaults = 0;
  for (const TableSchema& table : case_schema()) {
    for (const KeySchema& key : table.keys) {
      const PageRow row = page_row(table.name, key.name);
      const std::string name =
          fmt::format("docs/case_file.md: {} `{}`", header_of(table), key.name);
      for (const std::string& text : expected_values(key.values)) {
        EXPECT_NE(row.values.find(text), std::string::npos)
            << name << ": its values are \"" << row.values << "\" without \"" << text << "\"";
      }
      const auto usual = default_of(key);
      if (!usual || row.fallback.empty() || usual->kind == TomlValue::Kind::array) continue;
      ++defaults;
      EXPECT_NE(row.fallback.find(shown(*usual)), std::string::npos)
          << name << ": its default is \"" << row.fallback << "\" without " << shown(*usual);
    }
  }
  EXPECT_GT(defaults, 30);
}

}  // namespace
}  // namespace perilink::quality
