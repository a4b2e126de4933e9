#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Rules of lattice bodies and explicit analyses in [body], [[materials]] and [analysis].

namespace perilink {

/// Checks [body] for model = "lattice".
/// \param only  the pattern of these bodies
void check_lattice_body(const CaseTable& table, const BodySection& body, Pattern only);

/// Returns the defaults of materials of state-based particles, from the papers of the rules.
LatticeMaterialSection usual_state_material(LatticeRules rules);
/// Reads the law of state-based particles, and checks it.
void check_state_material(const CaseTable& table, const CaseFile& input, MaterialSection& material);
void write_state_law(TomlWriter& out, const LatticeMaterialSection& section);

/// Refuses tables that lattice bodies and explicit analyses cannot have.
void check_lattice(const CaseFile& input);

}  // namespace perilink
