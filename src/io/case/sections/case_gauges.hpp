#pragma once

#include <array>
#include <string>

#include "io/case/case_file.hpp"

namespace perilink {

/// Returns the name of a component of the stress in the case file: "xx", "xy".
std::string stress_name(const std::array<int, 2>& axes);

/// Refuses two gauges of one name, and stresses that are not available for the body.
/// \throws InputError
void check_gauges(const CaseFile& input);

}  // namespace perilink
