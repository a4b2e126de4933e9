#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "discretization/meshes/mesh.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// The mesh that a case names.
struct MeshInput {
  Mesh mesh;
  std::vector<Index> material;          ///< per cell; no_index where no material covers it
  std::vector<std::string> notes = {};  ///< on its unit and the names of its groups
};

/// Reads a file of a mesh, or meshes a geometry.
/// \param key   that names the file, for messages
/// \param file  as seen from the folder of the case
/// \param size  wanted for the cells, where it is a geometry
/// \throws InputError  where it cannot be read
Mesh read_mesh(const CaseFile& input, const std::string& key, const std::string& file,
               std::optional<double> size, int dim);

/// Reads the mesh that is the body of a case.
/// \throws InputError  where the mesh cannot be read, or lacks a group or its cells
MeshInput read_mesh_input(const CaseFile& input, int dim);

/// The physical group of a region, which must consist of cells.
/// \param key       place in the case, for messages
/// \param contents  what the region should hold, for messages
/// \throws InputError  where it consists of what has no area (2D) or volume (3D)
const MeshGroup& group_of_cells(const CaseFile& input, const Mesh& mesh, const Region& region,
                                const std::string& key, const std::string& contents);

/// Reads the mesh that a case names and makes its body.
/// \param notes  gets a line where cells are left out because they have no material
/// \throws InputError  where the mesh cannot be read, is damaged or does not suit the case: a group
///         that it lacks, a material for a group without cells, cells that overlap
Body read_mesh_body(const CaseFile& input, int dim, std::vector<std::string>& notes);

/// Refuses a group of lines that are not all sides of cells: what lies beside the mesh is lost.
/// \param key  that names the group, for messages
/// \throws InputError
void refuse_loose_lines(const CaseFile& input, const std::string& key, const Body& body,
                        const Group& group);

/// The case with its mesh named as seen from a folder, so that it can be written there.
CaseFile seen_from(const CaseFile& input, const std::filesystem::path& directory);

}  // namespace perilink
