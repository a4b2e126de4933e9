#pragma once

#include "io/case/case_file.hpp"

namespace perilink {

/// Refuses keys that Green strains and [[velocities]] exclude.
void check_moving_bonds(const CaseFile& input);

}  // namespace perilink
