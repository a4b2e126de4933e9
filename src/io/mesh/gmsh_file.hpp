#pragma once

#include <string>
#include <string_view>

#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Reads a mesh of gmsh's format 4.1, text or binary: triangles and lines in two dimensions,
/// tetrahedra and triangles in three, with the physical groups of every dimension. A group without
/// a name is named by its number. Cells without a group are kept, other elements without a group
/// are not. Groups are sorted by dimension and tag; groups of equal dimension and name are merged.
/// \param dim  2 or 3
/// \throws FileError   where the file cannot be read
/// \throws InputError  where the file is not a mesh, is damaged, or has another dimension
Mesh read_gmsh_file(const std::string& path, int dim);

/// Reads a mesh from the bytes of a file, for tests and fuzzing.
Mesh parse_gmsh(std::string_view bytes, const std::string& path, int dim);

}  // namespace perilink
