#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Keys of explicit analyses and dynamic relaxation of bonds.

namespace perilink {

/// Reads the key `strain` of [analysis].
void read_strain(const CaseTable& table, AnalysisSection& analysis);

/// Reads the key `tolerance` of [analysis].
double read_tolerance(const CaseTable& table, double usual);

/// Reads the keys of [analysis] for type = "relaxation".
void read_relaxation(const CaseTable& table, AnalysisSection& analysis);
void write_relaxation(TomlWriter& out, const CaseFile& input);

/// Refuses keys that Green strains and [[velocities]] exclude.
void check_moving_bonds(const CaseFile& input);

}  // namespace perilink
