#pragma once

#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"
#include "material/softening.hpp"

/// \file Keys of [[materials]] for the softening of bonds. The default is brittle, and bilinear
///     where a tensile strength is given.

namespace perilink {

SofteningMaterial read_softening(const CaseTable& table);
void write_softening(TomlWriter& out, const SofteningMaterial& material);

/// Whether stretches give the law, in place of strength and fracture energy.
inline bool has_stretches(const SofteningMaterial& material) { return material.stretches[0] > 0.0; }

/// Refuses every key of softening in a material that cannot break.
void refuse_softening(const CaseTable& table);

}  // namespace perilink
