#include "io/case/case_page.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "io/text/input_text.hpp"

namespace perilink {

/// Headings and rows of tables of docs/case_file.md, which the build reads.
extern const char* const case_page;

namespace {

/// Keys of a table, "body.spacing", and their rows.
using Rows = std::map<std::string, PageRow>;

std::vector<std::string_view> split(std::string_view text, char sign) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(sign);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Returns Markdown without links and the marks of code.
std::string plain(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::size_t end = text.find(']', k);
    const bool in_link = end != text.npos && text.substr(end, 2) == "](";
    if (text[k] == '[' && in_link) continue;
    if (k == end && in_link) {
      k = std::min(text.find(')', k), text.size());
    } else if (text[k] != '`') {
      result += text[k];
    }
  }
  return result;
}

/// Returns the words between backquotes.
std::vector<std::string> code_words(std::string_view cell) {
  std::vector<std::string> words;
  const auto parts = split(cell, '`');
  for (std::size_t k = 1; k < parts.size(); k += 2) words.emplace_back(parts[k]);
  return words;
}

/// Returns the table that a heading names, or "-".
std::string table_of(std::string_view heading) {
  const std::size_t first = heading.find('[');
  if (first == heading.npos) return "-";
  const std::size_t begin = heading.find_first_not_of('[', first);
  return std::string(heading.substr(begin, heading.find(']', begin) - begin));
}

void add(std::string& text, std::string_view more) {
  if (text.find(more) != text.npos) return;
  text += (text.empty() ? "" : "; ") + std::string(more);
}

Rows read_page() {
  Rows rows;
  std::string chapter, table;  // of the headings of the second rank and of any
  for (const std::string_view line : split(case_page, '\n')) {
    if (line.starts_with("##")) {
      const std::string named = table_of(line);
      const bool is_chapter = line.starts_with("## ");
      if (is_chapter) chapter = named == "-" ? "" : named;
      table = named == "-" ? chapter : named;
      continue;
    }
    const std::vector<std::string_view> cells = split(line, '|');
    if (cells.size() < 5) continue;  // an empty cell at each end
    for (const std::string& key : code_words(cells[1])) {
      PageRow& row = rows[table + "." + key];
      add(row.values, plain(cells[2]));
      if (cells.size() > 5) add(row.fallback, plain(cells[3]));
      add(row.meaning, plain(cells[cells.size() - 2]));
    }
  }
  return rows;
}

}  // namespace

PageRow page_row(std::string_view table, std::string_view key) {
  static const Rows rows = read_page();
  const std::string name(key);
  const auto found = rows.find(std::string(table) + "." + name);
  if (found == rows.end()) return {};
  if (!found->second.values.starts_with("as of ")) return found->second;
  for (const char* other : {"materials", "cracks", "body", "stop", "displacements"}) {
    const auto elsewhere = rows.find(std::string(other) + "." + name);
    if (elsewhere != rows.end() && elsewhere != found) return elsewhere->second;
  }
  return found->second;
}

}  // namespace perilink
