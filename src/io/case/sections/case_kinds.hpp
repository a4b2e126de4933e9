#pragma once

#include <string>

#include "io/case/case_file.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_table.hpp"

/// \file
/// What kind of body a case has, and the keys that several kinds share.

namespace perilink {

/// The kind of a case, for the columns of case_schema(): its body, dimensions and analysis.
Kinds kinds_of(const CaseFile& input);

/// Coordinates of a place in the body: 2 or 3; 2 in shells, whose places are those of the sheet.
int dimension_of(const BodySection& body);

/// Axes along which the body moves and is loaded: as many, but 3 in shells.
int axes_of(const BodySection& body);

bool is_shell(const BodySection& body);
bool is_beam(const BodySection& body);

/// Whether an analysis of the type finds equilibria one after the other, without motion.
inline bool is_quasistatic(AnalysisType type) {
  return type == AnalysisType::damage || type == AnalysisType::elastic;
}

/// Whether [body] says model = "lattice".
bool is_lattice(const BodySection& body);

/// Whether [body] says model = "particles".
bool is_particles(const BodySection& body);

/// Whether it says either.
bool has_state_based_particles(const BodySection& body);

/// The event tolerance of a damage analysis: the one given, else 0.01 where a material or an
/// interface softens, and 0 where none does.
double event_tolerance_of(const CaseFile& input);

/// Why particles have no rotations where the body is not micropolar, and what would give them some:
/// parts of refusals.
std::string why_nothing_rotates(const BodySection& body);
std::string what_rotates(const BodySection& body);

/// `mesh` and `mesh_size`, where a table has them.
void read_mesh_file(const CaseTable& table, std::optional<std::string>& mesh,
                    std::optional<double>& size);

/// The word for an energy that no crack or flow takes up.
inline constexpr const char* infinite_energy = "infinite";

/// A positive number, or infinity for that word.
/// \param meaning  what the key is, where it is missing
double read_energy(const CaseTable& table, const std::string& key, const std::string& meaning);
/// Infinity where an elastic analysis, which does not need it, has none.
double read_fracture_energy(const CaseTable& table, AnalysisType type);

}  // namespace perilink
