#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"

namespace perilink {

RandomSection read_random(const CaseTable& table, Kinds kind);
GradedSection read_graded(const CaseTable& table, Kinds kind);

/// Returns whether the analysis uses a field; elastic ones only use Young's modulus.
bool is_used(const CaseFile& input, const VaryingSection& section);

/// Returns the keys of tables in [[random]] and [[graded]] that the analysis does not use.
std::vector<std::string> unused_fields(const CaseFile& input);

/// Returns the materials whose property varies: nonzero, per material.
std::vector<std::uint8_t> materials_that_vary(const CaseFile& input, const VaryingSection& section);

/// Refuses [[random]] and [[graded]] of materials without the property, of bonds in bodies without
/// bonds, of Young's modulus in some materials only, and two tables of one kind for one property of
/// a material.
void check_fields(const CaseFile& input);

}  // namespace perilink
