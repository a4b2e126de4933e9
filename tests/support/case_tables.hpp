#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

/// Cases written as edits of a base, in the tables of tests/cli/malformed.
/// docs/developers/testing.md describes an entry.

namespace perilink::test {

/// Entry of a table.
struct CaseEntry {
  std::string name;
  std::string base;                   ///< file in bases/, or "nothing"
  std::vector<std::string> edits;     ///< lines of the table, each with its mark
  std::vector<std::string> expected;  ///< texts that the message must contain
};

/// Prints an entry for googletest.
inline void PrintTo(const CaseEntry& entry, std::ostream* stream) { *stream << entry.name; }

inline std::filesystem::path malformed_folder() {
  return std::filesystem::path(PERILINK_SOURCE_DIR) / "tests/cli/malformed";
}

/// Returns files of a folder in alphabetical order.
inline std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder,
                                                   const std::string& extension) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline void read_case_table(const std::filesystem::path& path, std::vector<CaseEntry>& entries) {
  std::ifstream file(path);
  int number = 0;
  const std::size_t before = entries.size();
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const bool marked = line.size() > 2 && line[1] == ' ';
    const std::size_t colon = line.find(": ");
    if (marked && line[0] == '?' && entries.size() > before) {
      entries.back().expected.push_back(line.substr(2));
    } else if (marked && std::string("@-+~").find(line[0]) < 4 && entries.size() > before) {
      entries.back().edits.push_back(line);
    } else if (!marked && colon != std::string::npos) {
      entries.push_back({line.substr(0, colon), line.substr(colon + 2), {}, {}});
    } else {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + line);
    }
  }
}

/// Returns entries of all tables in a folder of tests/cli/malformed.
inline std::vector<CaseEntry> read_case_tables(const std::string& folder) {
  std::vector<CaseEntry> entries;
  for (const auto& path : files_of(malformed_folder() / folder, ".txt")) {
    read_case_table(path, entries);
  }
  return entries;
}

inline std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find(separator, start)) != std::string::npos;) {
    parts.push_back(text.substr(start, end - start));
    start = end + separator.size();
  }
  parts.push_back(text.substr(start));
  return parts;
}

/// Repeats {{300 * ab}} and replaces {{xFC}} by the byte.
inline std::string spelled_out(const std::string& text) {
  std::string result;
  std::size_t start = 0;
  for (std::size_t open; (open = text.find("{{", start)) != std::string::npos;) {
    const std::size_t close = text.find("}}", open);
    if (close == std::string::npos) throw std::runtime_error("{{ without }}: " + text);
    const std::string inner = text.substr(open + 2, close - open - 2);
    result += text.substr(start, open - start);
    if (inner[0] == 'x') {
      result += static_cast<char>(std::stoi(inner.substr(1), nullptr, 16));
    } else {
      const std::vector<std::string> factors = split(inner, " * ");
      for (int k = std::stoi(factors.at(0)); k > 0; --k) result += factors.at(1);
    }
    start = close + 2;
  }
  return result + text.substr(start);
}

/// Applies edits to the text of a base.
class LineEditor {
 public:
  explicit LineEditor(const std::string& text) : lines_(split(text, "\n")) { lines_.pop_back(); }

  void apply(const std::string& edit) {
    const std::string text = edit.substr(2);
    switch (edit[0]) {
      case '@':
        find(text);
        ++cursor_;
        break;
      case '-':
        for (const std::string& line : split(text, " | ")) remove(line);
        break;
      case '+': insert(text); break;
      default: {
        const std::size_t arrow = text.find(" -> ");
        if (arrow == std::string::npos) throw std::runtime_error("no arrow: " + edit);
        remove(text.substr(0, arrow));
        insert(text.substr(arrow + 4));
      }
    }
  }

  std::string text() const {
    std::string result;
    for (const std::string& line : lines_) result += line + "\n";
    return result;
  }

 private:
  void find(const std::string& line) {
    while (cursor_ < lines_.size() && lines_[cursor_] != line) ++cursor_;
    if (cursor_ == lines_.size()) throw std::runtime_error("the base has no such line: " + line);
  }
  void remove(const std::string& line) {
    find(line);
    lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(cursor_));
  }
  void insert(const std::string& text) {
    for (const std::string& line : split(text, " | ")) {
      lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(cursor_), spelled_out(line));
      ++cursor_;
    }
  }

  std::vector<std::string> lines_;
  std::size_t cursor_ = 0;
};

/// Returns the text of a case.
/// \param base  text of its base
inline std::string edited_text(const CaseEntry& entry, const std::string& base) {
  LineEditor editor(base);
  for (const std::string& edit : entry.edits) editor.apply(edit);
  return editor.text();
}

/// Returns the text of a case with a file as base.
inline std::string case_text(const CaseEntry& entry) {
  if (entry.base == "nothing") return edited_text(entry, "");
  const std::filesystem::path path = malformed_folder() / "bases" / (entry.base + ".toml");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(entry.name + ": no base " + path.string());
  return edited_text(entry, {std::istreambuf_iterator<char>(file), {}});
}

}  // namespace perilink::test
