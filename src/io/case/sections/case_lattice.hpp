#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// Lattice bodies and the explicit analyses that move them: what their keys in [body],
/// [[materials]] and [analysis] have of their own.

namespace perilink {

/// The keys of [body] below `model`.
void read_lattice_body(const CaseTable& table, BodySection& body);

/// What materials of state-based particles have, on a lattice or anywhere.
void read_state_material(const CaseTable& table, const CaseFile& input, MaterialSection& material);
/// Yield strength and what goes with it.
void read_lattice_yielding(const CaseTable& table, const BodySection& body,
                           LatticeMaterialSection& section);

/// Keys of [analysis] that only type = "explicit" has; it must have a duration.
void read_explicit_analysis(const CaseTable& table, AnalysisSection& analysis);

void write_lattice_body(TomlWriter& out, const BodySection& body);
void write_state_material(TomlWriter& out, const LatticeMaterialSection& section, bool on_lattice);
void write_lattice_yielding(TomlWriter& out, const LatticeMaterialSection& section);
void write_explicit_analysis(TomlWriter& out, const CaseFile& input);

/// Refuses what lattice bodies and explicit analyses cannot be combined with.
void check_lattice(const CaseFile& input);

}  // namespace perilink
