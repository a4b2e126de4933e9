#pragma once

#include "io/case/case_file.hpp"

namespace perilink {

/// Refuses what is wrong between the tables of a case: names that no region has, contradictory
/// supports, a body that nothing loads.
/// \throws InputError
void check_rules(const CaseFile& input);

}  // namespace perilink
