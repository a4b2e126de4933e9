// The user's page of the case file names every key that the reader accepts.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/case/case_keys.hpp"
#include "quality/source_tree.hpp"

namespace perilink::quality {
namespace {

std::string header_of(const TableSchema& table) {
  const std::string name(table.name);
  return table.list ? "[[" + name + "]]" : "[" + name + "]";
}

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

}  // namespace
}  // namespace perilink::quality
