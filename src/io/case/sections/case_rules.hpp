#pragma once

#include "io/case/case_file.hpp"

namespace perilink {

/// Refuses contradictions between the tables of a case: unknown regions, contradictory supports, a
/// body without load.
/// \throws InputError
void check_rules(const CaseFile& input);

}  // namespace perilink
