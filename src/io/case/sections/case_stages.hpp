#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"

/// \file
/// [[stages]], and `stage` of the tables that load the body.

namespace perilink {

StageSection read_stage(const CaseTable& table, Kinds kind);

/// Assigns every load to its stage, and checks that stages and loads match.
/// \throws InputError
void resolve_stages(CaseFile& input);

}  // namespace perilink
