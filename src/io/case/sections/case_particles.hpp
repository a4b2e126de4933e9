#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file
/// Bodies of state-based particles that stand anywhere: what their keys in [body] and [[materials]]
/// have of their own.

namespace perilink {

/// Refuses keys of [body] that speak of horizons and bonds.
void refuse_horizon_keys(const CaseTable& table);

/// Poisson's ratio, density and softening.
void read_particle_material(const CaseTable& table, const BodySection& body,
                            MaterialSection& material);
void write_particle_material(TomlWriter& out, const MaterialSection& material);

/// Refuses what such bodies cannot be combined with.
void check_particles(const CaseFile& input);

}  // namespace perilink
