#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/report/report_units.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// A table of a case in words: a heading, and per entry a name and its keys with values and units.
struct WordedTable {
  std::string heading;
  std::vector<std::pair<std::string, std::string>> entries;
};

/// Returns every table of a resolved case, in the file's order.
std::vector<WordedTable> tables_of_case(const TomlValue& root, const UnitNames& units);

/// Returns what a run is and how it ended, in sentences. Unknown facts are left out.
/// \param summary  summary.json; an empty object where there is none
/// \param root     case.toml; an empty table where it cannot be read
std::vector<std::string> sentences_of_run(const nlohmann::ordered_json& summary,
                                          const TomlValue& root, const UnitNames& units);

}  // namespace perilink
