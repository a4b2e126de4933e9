#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file [[rebar]]: geometry of bars, their steel and their bond.

namespace perilink {

RebarSection read_rebar(const CaseTable& table, Kinds kind);

/// Refuses bars that contradict other tables.
void check_rebar(const CaseFile& input);

/// Writes the points, the layout or the group of bars.
void write_bar_place(TomlWriter& out, const RebarSection& bar, Kinds kind);

}  // namespace perilink
