#pragma once

#include <array>
#include <string>

#include "io/case/case_file.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {

/// Returns the name of a component of the stress in the case file: "xx", "xy".
std::string stress_name(const std::array<int, 2>& axes);

void write_gauges(TomlWriter& out, const CaseFile& input);

/// Refuses two gauges of one name, and stresses that are not available for the body.
/// \throws InputError
void check_gauges(const CaseFile& input);

}  // namespace perilink
