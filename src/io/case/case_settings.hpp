#pragma once

#include <string>
#include <vector>

#include "io/text/toml_tree.hpp"

/// \file Other values of keys of a case, from the command line or a scan.

namespace perilink {

/// A key of a case and its value.
struct CaseSetting {
  std::string key;  ///< "materials[1].area", "materials.steel.area": entries by number or name
  TomlValue value;
};

/// Reads KEY=VALUE, as the option --set has it. VALUE is TOML; words that are no TOML value are
/// text.
/// \throws InputError
CaseSetting parse_setting(const std::string& text);
std::vector<CaseSetting> parse_settings(const std::vector<std::string>& texts);

/// Returns KEY=VALUE, which parse_setting() reads back.
std::string setting_text(const CaseSetting& setting);

/// Sets keys of a case's document. A key replaces its alternatives, as `spacing` replaces
/// `columns`. Unknown keys and tables are added, for check_against_schema() to refuse.
/// \param path  of the case, only named in messages
/// \throws InputError  where a list has no such entry, or keys exclude each other
void apply_settings(TomlValue& document, const std::string& path,
                    const std::vector<CaseSetting>& settings);

}  // namespace perilink
