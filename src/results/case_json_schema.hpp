#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/case/case_schema.hpp"

namespace perilink {

/// Returns the default of a key, if it has one that does not depend on other keys.
std::optional<TomlValue> default_of(const KeySchema& key);

/// Returns the names of all keys as --set has them: "body.spacing", "materials[1].density".
std::vector<std::string> settable_keys();

/// Returns the JSON schema (draft 7) of case files, for editors: types, ranges and defaults of
/// case_schema(), units and meanings of docs/case_file.md.
std::string case_json_schema();

/// Returns tables and keys with values, defaults and meanings as text, for help in a terminal.
std::string case_reference();

}  // namespace perilink
