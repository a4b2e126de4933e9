#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Readers of the tables of a case. Each checks its table; case_rules.hpp checks tables
///     against each other.

namespace perilink {

/// \param body  problem, method and model, which are read first
/// \param kind  of the case
BodySection read_body(const CaseTable& table, BodySection body, Kinds kind);
Region read_region(const CaseTable& table, int dim);
void write_region(TomlWriter& out, const Region& region, int dim);
/// \param input  with its kind and body, which are read first
/// \param index  zero-based, for the name of a material without one
MaterialSection read_material(const CaseTable& table, const CaseFile& input, std::size_t index);
SupportSection read_support(const CaseTable& table, const CaseFile& input);
/// \param name  "displacements" or "velocities"
DisplacementSection read_displacement(const CaseTable& table, const char* name, Kinds kind);
LoadSection read_load(const CaseTable& table, Kinds kind);
TractionSection read_traction(const CaseTable& table, Kinds kind);
PointLoadSection read_point_load(const CaseTable& table, Kinds kind);
SpringSection read_springs(const CaseTable& table, Kinds kind);
CrackSection read_crack(const CaseTable& table, Kinds kind);
GaugeSection read_gauge(const CaseTable& table, Kinds kind);
AnalysisSection read_analysis(const CaseTable& table, Kinds kind);
/// Refuses a rule of a gauge without its limit.
void check_rules_of_gauge(const CaseTable& table);
StopSection read_stop(const CaseTable& table, Kinds kind);

/// Refuses a hole whose box meets that of no region of the material.
/// \param key  of the holes
void refuse_hole_outside(const CaseFile& input, const MaterialSection& material,
                         const std::string& key, const std::string& hole);

}  // namespace perilink
