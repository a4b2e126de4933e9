#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file [[rebar]]: geometry of bars, their steel and their bond.

namespace perilink {

RebarSection read_rebar(const CaseTable& table, int dim);

/// Refuses bars that contradict other tables.
void check_rebar(const CaseFile& input);

void write_rebar(TomlWriter& out, const RebarSection& bar, int dim);

}  // namespace perilink
