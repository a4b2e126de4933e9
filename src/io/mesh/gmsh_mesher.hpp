#pragma once

#include <optional>
#include <string>

#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Whether the program was built with gmsh's library. It is loaded when it is first used: linking
/// it would cost every run a tenth of a second.
bool has_gmsh();

/// Meshes a geometry with gmsh's library.
/// \param size  wanted for all cells [length]; a script gets it as the value of its constant `h`
/// \param trusted  scripts may run commands and write files (gmsh_script.hpp)
/// \throws FileError   where the geometry cannot be read
/// \throws InputError  where gmsh is missing or cannot mesh it, or a script has no constant `h` to
///     set, or does more than draw and mesh without being trusted
Mesh mesh_geometry(const std::string& path, int dim, std::optional<double> size,
                   bool trusted = false);

}  // namespace perilink
