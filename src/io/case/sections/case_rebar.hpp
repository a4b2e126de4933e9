#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// [[rebar]]: where bars are, their steel and what holds them.

namespace perilink {

RebarSection read_rebar(const CaseTable& table, int dim);

/// What contradicts other tables.
void check_rebar(const CaseFile& input);

void write_rebar(TomlWriter& out, const RebarSection& bar, int dim);

}  // namespace perilink
