#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// Bonds that move, in explicit analyses or towards equilibrium by dynamic relaxation: what their
/// cases have of their own.

namespace perilink {

/// The key `strain` of [analysis].
void read_strain(const CaseTable& table, AnalysisSection& analysis);

/// The key `tolerance` of [analysis].
double read_tolerance(const CaseTable& table, double usual);

/// Keys of [analysis] that only type = "relaxation" has.
void read_relaxation(const CaseTable& table, AnalysisSection& analysis);
void write_relaxation(TomlWriter& out, const CaseFile& input);

/// Refuses what Green strains and [[velocities]] cannot be combined with.
void check_moving_bonds(const CaseFile& input);

}  // namespace perilink
