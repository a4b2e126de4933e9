#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/text/toml_tree.hpp"

namespace perilink {

/// Looks for keys and tables of a case that its kind has no use for, by the columns of
/// case_schema(). One case may so serve an implicit and an explicit run, which differ in `type`
/// alone.
/// \param kind  problem, method and model of its [body] and type of its [analysis] count
/// \return those that are set aside; their values are to be checked and forgotten
/// \throws InputError for those that are refused
std::vector<std::string> find_unused(const TomlValue& document, const CaseFile& kind);

/// What a user should know of those set aside; nothing where all keys are used.
std::optional<std::string> note_of_unused(const CaseFile& input);

}  // namespace perilink
