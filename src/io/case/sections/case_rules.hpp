#pragma once

#include "io/case/case_file.hpp"

namespace perilink {

/// Round-off of stiff materials exceeds small forces in soft ones. In a strip of two materials the
/// load of the soft half was wrong by 2e-7 for a ratio of 1e10, by 1e-3 for 1e14.
constexpr double largest_stiffness_ratio = 1e10;

/// Refuses contradictions between the tables of a case: unknown regions, contradictory supports, a
/// body without load.
/// \throws InputError
void check_rules(const CaseFile& input);

}  // namespace perilink
