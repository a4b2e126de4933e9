#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"

namespace perilink {

RandomSection read_random(const CaseTable& table, Kinds kind);

/// Returns the materials of a [[random]] that scatter: nonzero, per material.
std::vector<std::uint8_t> materials_that_scatter(const CaseFile& input,
                                                 const RandomSection& section);

/// Refuses [[random]] of materials without the property, and two tables for one property of a
/// material. Elastic analyses use neither.
void check_random(const CaseFile& input);

}  // namespace perilink
