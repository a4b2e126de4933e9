#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// Finds keys and tables that the kind of case does not use, by case_schema(). So one case can be
/// used for implicit and explicit runs, which differ only in `type`.
/// \param kind  its problem, method, model and type of analysis are used
/// \return keys and tables that are checked but not used
/// \throws InputError  where a key or table is refused
std::vector<std::string> find_unused(const TomlValue& document, const CaseFile& kind);

/// Returns a note about unused keys; std::nullopt where all keys are used.
std::optional<std::string> note_of_unused(const CaseFile& input);

}  // namespace perilink
