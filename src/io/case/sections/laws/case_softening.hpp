#pragma once

#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"
#include "material/softening.hpp"

/// \file
/// Keys of [[materials]] that say how bonds soften. What they leave out is brittle; a material with
/// a tensile strength and no word about its softening is bilinear.

namespace perilink {

SofteningMaterial read_softening(const CaseTable& table);
void write_softening(TomlWriter& out, const SofteningMaterial& material);

/// Whether the law is given by its stretches in place of strength and fracture energy.
inline bool has_stretches(const SofteningMaterial& material) { return material.stretches[0] > 0.0; }

/// Refuses every key of them in a material that cannot break.
void refuse_softening(const CaseTable& table);

}  // namespace perilink
