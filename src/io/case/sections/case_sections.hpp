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

/// \param kind  problem, method and model, which are read first
BodySection read_body(const CaseTable& table, const BodySection& kind);
Region read_region(const CaseTable& table, int dim);
void write_region(TomlWriter& out, const Region& region, int dim);
/// \param input  with its kind and body, which are read first
/// \param index  zero-based, for the name of a material without one
MaterialSection read_material(const CaseTable& table, const CaseFile& input, std::size_t index);
SupportSection read_support(const CaseTable& table, const BodySection& body);
DisplacementSection read_displacement(const CaseTable& table, const BodySection& body);
LoadSection read_load(const CaseTable& table, const BodySection& body);
TractionSection read_traction(const CaseTable& table, const BodySection& body);
PointLoadSection read_point_load(const CaseTable& table, const BodySection& body);
SymmetrySection read_symmetry(const CaseTable& table, int dim);
SpringSection read_springs(const CaseTable& table, int dim);
CrackSection read_crack(const CaseTable& table, int dim);
GaugeSection read_gauge(const CaseTable& table, const BodySection& body);
/// Reads the load factors, which must be given.
std::vector<double> read_load_factors(const CaseTable& table);
AnalysisSection read_analysis(const CaseTable& table, AnalysisType type);
StopSection read_stop(const CaseTable& table);
OutputSection read_output(const CaseTable& table, AnalysisType type);

}  // namespace perilink
