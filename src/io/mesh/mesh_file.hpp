#pragma once

#include <string>
#include <string_view>

#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Reads a mesh: an input file of Abaqus (.inp), else a .msh file of gmsh (4.1 or 2.2, text or
/// binary). Cells without a group are kept, other elements without a group are not.
/// \param dim  2 or 3
/// \throws FileError   where the file cannot be read
/// \throws InputError  where the file is not a mesh, is damaged, or has another dimension
Mesh load_mesh(const std::string& path, int dim);

/// Reads a mesh from the bytes of a file.
Mesh parse_mesh(std::string_view bytes, const std::string& path, int dim);

}  // namespace perilink
