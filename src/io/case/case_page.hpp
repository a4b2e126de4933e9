#pragma once

#include <string>
#include <string_view>

namespace perilink {

/// Rows of docs/case_file.md on a key of a table, as plain text.
struct PageRow {
  std::string values;    ///< with unit in brackets, L, F, T and M
  std::string fallback;  ///< default; empty: the page has no such column
  std::string meaning;
};

/// Returns the row of a key; several rows joined by semicolons. A row that refers to another table
/// is replaced by the row of that table. Empty: the page has none.
PageRow page_row(std::string_view table, std::string_view key);

}  // namespace perilink
