#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "discretization/meshes/mesh.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Mesh of a case with its materials.
struct MeshInput {
  Mesh mesh;
  std::vector<Index> material;          ///< per cell; no_index where no material covers it
  std::vector<std::string> notes = {};  ///< on its unit and the names of its groups
};

/// Reads a mesh file, or meshes a geometry file.
/// \param key     key that names the file, for messages
/// \param source  names a file; the size of its cells is in the unit of the case
/// \throws InputError  where it cannot be read
Mesh read_mesh(const CaseFile& input, const std::string& key, const MeshSource& source, int dim);

/// Reads the mesh that is the body of a case.
/// \throws InputError  where the mesh cannot be read, or lacks a group or its cells
MeshInput read_mesh_input(const CaseFile& input, int dim);

/// Returns the group of a region, which must consist of cells.
/// \param key       place in the case, for messages
/// \param contents  what the region should hold, for messages
/// \throws InputError  where the group has no area (2D) or volume (3D)
const MeshGroup& group_of_cells(const CaseFile& input, const Mesh& mesh, const Region& region,
                                const std::string& key, const std::string& contents);

/// Reads the mesh that a case names and makes its body.
/// \param notes  receives a note where cells without material are left out
/// \throws InputError  where the mesh cannot be read, is damaged or does not suit the case: a group
///         that it lacks, a material for a group without cells, cells that overlap
Body read_mesh_body(const CaseFile& input, int dim, std::vector<std::string>& notes);

/// Returns the case with paths of meshes and fields relative to a folder, to be written there.
CaseFile seen_from(const CaseFile& input, const std::filesystem::path& directory);

/// Returns a checksum of the contents of a case's files of meshes and fields; empty without such a
/// file, or if one cannot be read.
std::string mesh_checksum(const CaseFile& input);

}  // namespace perilink
