#pragma once

#include <string>

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// [[stages]], and `stage` of the tables that load the body.

namespace perilink {

StageSection read_stage(const CaseTable& table);

/// Assigns every load to its stage, and checks that stages and loads match.
/// \throws InputError
void resolve_stages(CaseFile& input);

void write_stop(TomlWriter& out, const StopSection& stop);
/// Writes [stop] of a run over time, which has only a rule by a gauge.
void write_gauge_rule(TomlWriter& out, const StopSection& stop);
void write_stage(TomlWriter& out, const StageSection& stage);
/// Writes the key `stage` of a load where the case has stages.
void write_stage_of(TomlWriter& out, const std::string& stage);

}  // namespace perilink
