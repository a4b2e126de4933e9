#pragma once

#include <string>

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// [[stages]], and `stage` of the tables that load the body.

namespace perilink {

StageSection read_stage(const CaseTable& table);

/// Gives every load its stage, and checks that stages and loads fit each other.
/// \throws InputError
void resolve_stages(CaseFile& input);

void write_stop(TomlWriter& out, const StopSection& stop);
void write_stage(TomlWriter& out, const StageSection& stage);
/// The key `stage` of a load; nothing where the case has no stages.
void write_stage_of(TomlWriter& out, const std::string& stage);

}  // namespace perilink
