#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_tree.hpp"

namespace perilink {

/// A table that a case may have.
struct TableSchema {
  std::string_view name;               ///< empty: the top of the file
  bool list = false;                   ///< written [[name]], any number of times
  std::vector<std::string_view> keys;  ///< in the order of the reference page
};

/// Every table and key of a case.
const std::vector<TableSchema>& case_schema();

/// Refuses every table and key that a schema lacks, [name] in place of [[name]] and vice versa.
/// \param schema         the top of the file first
/// \param document_name  "case", for messages
/// \throws InputError
void check_against_schema(const TomlValue& document, const std::string& path,
                          const std::vector<TableSchema>& schema, std::string_view document_name);

/// The same with the schema of a case.
void check_against_schema(const TomlValue& document, const std::string& path);

/// "did you mean `horizon`? Allowed: ..." with the allowed word nearest in spelling, if any is
/// near.
std::string suggest(const std::string& word, const std::vector<std::string_view>& allowed);

/// Least number of letters inserted, deleted, replaced or exchanged with their neighbour that turns
/// one word into the other.
int edit_distance(std::string_view a, std::string_view b);

}  // namespace perilink
