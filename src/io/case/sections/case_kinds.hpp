#pragma once

#include <string>
#include <vector>

#include "io/case/case_file.hpp"
#include "io/case/case_schema.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

/// \file Kinds of bodies, and keys that several kinds share.

namespace perilink {

/// Returns the kind of a case for case_schema(): its body, dimensions and analysis.
Kinds kinds_of(const CaseFile& input);

/// Returns the number of coordinates of a position: 2 or 3; 2 on the mid-surface of a shell.
int dimension_of(const BodySection& body);

/// Returns the number of axes of displacements and loads: 2 or 3; 3 in shells.
int axes_of(const BodySection& body);

bool is_shell(const BodySection& body);
bool is_beam(const BodySection& body);

/// Whether particles are the vertices of cells: of a mesh, or of the pattern "unstructured".
inline bool has_cells(const BodySection& body) { return body.pattern == Pattern::irregular; }

/// Whether an analysis of the type finds a sequence of static equilibria.
inline bool is_quasistatic(AnalysisType type) {
  return type == AnalysisType::damage || type == AnalysisType::elastic;
}

/// Whether the case has model = "lattice" in [body].
bool is_lattice(const BodySection& body);

/// Whether the case has model = "particles" in [body].
bool is_particles(const BodySection& body);

/// Whether the case has model = "lattice" or "particles" in [body].
bool has_state_based_particles(const BodySection& body);

/// Returns the event tolerance of a damage analysis: the given one, else 0.01 where a material or
/// an interface softens, else 0.
double event_tolerance_of(const CaseFile& input);

/// Returns the reason why particles have no rotations, for messages.
std::string why_nothing_rotates(const BodySection& body);
/// Returns a model whose particles have rotations, for the suggestion of a message.
std::string what_rotates(const BodySection& body);

/// Reads `mesh`, where a table has it, and checks `mesh_size`, which is read before.
void read_mesh_file(const CaseTable& table, MeshSource& source);

/// Physical group of the mesh that a case names.
struct NamedGroup {
  std::string key, name;
};

/// Returns the groups that the tables of a case name.
std::vector<NamedGroup> named_groups(const CaseFile& input);

/// Refuses a material without fracture energy; elastic analyses do not need it: infinity.
void need_fracture_energy(const CaseTable& table, AnalysisType type, MaterialSection& material);

}  // namespace perilink
