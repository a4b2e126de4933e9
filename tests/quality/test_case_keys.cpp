// The user's page of the case file names every key that the reader accepts, with its range, words
// and default.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <set>
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

/// Returns the range of numbers that the values of a page's row state.
Range range_on_page(const std::string& values) {
  static const std::string number = "(-?[0-9][0-9.]*(?:e-?[0-9]+)?)";
  static const std::regex open("in \\(" + number + ", " + number + "\\)");
  static const std::regex closed(number + " to (below )?" + number);
  static const std::regex least("(>=?) " + number + "(?:,? (?:up )?to (below )?" + number + ")?");
  std::smatch found;
  if (std::regex_search(values, found, open)) {
    return {std::stod(found[1]), std::stod(found[2]), true, true};
  }
  if (std::regex_search(values, found, least)) {
    const double most = found[4].matched ? std::stod(found[4]) : infinity;
    return {std::stod(found[2]), most, found[1] == ">", found[3].matched};
  }
  if (std::regex_search(values, found, closed)) {
    return {std::stod(found[1]), std::stod(found[3]), false, found[2].matched};
  }
  return {};
}

std::string shown(const Range& range) {
  const double most = range.most < std::numeric_limits<int>::max() ? range.most : infinity;
  return fmt::format("{}{} to {}{}", range.above ? "above " : "", range.least,
                     range.below ? "below " : "", most);
}

/// Returns the words of a page's values: parts of their list that are words of the case file.
std::set<std::string> words_on_page(std::string values) {
  std::erase(values, '"');
  static const std::regex part("(?:^|[,;:] )([-+a-z_0-9]+)(?=[,;]|$)");
  std::set<std::string> words;
  for (std::sregex_iterator found(values.begin(), values.end(), part), end; found != end; ++found) {
    words.insert((*found)[1]);
  }
  return words;
}

std::string shown(const TomlValue& value) {
  if (value.kind == TomlValue::Kind::text) return "\"" + value.text + "\"";
  if (value.kind == TomlValue::Kind::boolean) return value.boolean ? "true" : "false";
  if (value.kind != TomlValue::Kind::array) return fmt::format("{}", value.number);
  std::string list;
  for (const TomlValue& item : value.items) list += (list.empty() ? "" : ", ") + shown(item);
  return "[" + list + "]";
}

/// Calls visit(name, key, row of the page) for every key.
template <class Visit>
void for_each_row(Visit visit) {
  for (const TableSchema& table : case_schema()) {
    for (const KeySchema& key : table.keys) {
      visit(fmt::format("docs/case_file.md: {} `{}`", header_of(table), key.name), key,
            page_row(table.name, key.name));
    }
  }
}

TEST(CaseKeys, ThePageHasTheRangesOfTheSchema) {
  for_each_row([](const std::string& name, const KeySchema& key, const PageRow& row) {
    EXPECT_EQ(shown(range_on_page(row.values)), shown(key.values.range))
        << name << ": its values are \"" << row.values << "\"";
    if (key.values.kind == Values::Kind::integer) {
      EXPECT_NE(row.values.find("integer"), std::string::npos) << name;
    }
  });
}

TEST(CaseKeys, ThePageHasTheWordsOfTheSchema) {
  for_each_row([](const std::string& name, const KeySchema& key, const PageRow& row) {
    if (key.values.words.empty()) return;
    EXPECT_EQ(words_on_page(row.values),
              std::set<std::string>(key.values.words.begin(), key.values.words.end()))
        << name << ": its values are \"" << row.values << "\"";
  });
}

TEST(CaseKeys, ThePageHasTheDefaultsOfTheSchema) {
  int defaults = 0;
  for_each_row([&](const std::string& name, const KeySchema& key, const PageRow& row) {
    const auto usual = default_of(key);
    if (!usual || row.fallback.empty()) return;
    ++defaults;
    EXPECT_EQ(row.fallback, shown(*usual)) << name;
  });
  EXPECT_GT(defaults, 30);
}

}  // namespace
}  // namespace perilink::quality
