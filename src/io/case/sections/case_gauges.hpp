#pragma once

#include <array>
#include <string>

#include "io/case/case_file.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {

/// "xx", "xy": how the case file spells a component of the stress.
std::string stress_name(const std::array<int, 2>& axes);

void write_gauges(TomlWriter& out, const CaseFile& input);

/// Refuses two gauges of one name and stresses that the kind of body does not have.
/// \throws InputError
void check_gauges(const CaseFile& input);

}  // namespace perilink
