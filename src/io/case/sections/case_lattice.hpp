#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Keys of lattice bodies and explicit analyses in [body], [[materials]] and [analysis].

namespace perilink {

/// Reads the keys of [body] for model = "lattice".
void read_lattice_body(const CaseTable& table, BodySection& body);

/// Reads the keys of materials of state-based particles, on a lattice or at any positions.
void read_state_material(const CaseTable& table, const CaseFile& input, MaterialSection& material);
/// Reads the yield strength and the keys of hardening.
void read_lattice_yielding(const CaseTable& table, const BodySection& body,
                           LatticeMaterialSection& section);

/// Reads the keys of [analysis] for type = "explicit", which needs a duration.
void read_explicit_analysis(const CaseTable& table, AnalysisSection& analysis);

void write_lattice_body(TomlWriter& out, const BodySection& body);
void write_state_material(TomlWriter& out, const LatticeMaterialSection& section, bool on_lattice);
void write_lattice_yielding(TomlWriter& out, const LatticeMaterialSection& section);
void write_explicit_analysis(TomlWriter& out, const CaseFile& input);

/// Refuses tables that lattice bodies and explicit analyses cannot have.
void check_lattice(const CaseFile& input);

}  // namespace perilink
