#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Whether the program was built with gmsh's library. The library is loaded on first use: linking
/// it would add 0.1 s to every run.
bool has_gmsh();

/// Cells of the size given would exceed the free memory.
class CellSizeError : public Error {
 public:
  using Error::Error;
};

/// Meshes a geometry with gmsh's library.
/// \param size  size of all cells [length]; in a script the value of its constant `h`
/// \param trusted  scripts may run commands and write files (gmsh_script.hpp)
/// \throws FileError   where the geometry cannot be read
/// \throws InputError  where gmsh is missing or cannot mesh it, or a script has no constant `h` to
///     set, or does more than draw and mesh without being trusted
/// \throws CellSizeError  for a size that memory does not allow
Mesh mesh_geometry(const std::string& path, int dim, std::optional<double> size,
                   bool trusted = false);

/// Meshes the geometry that a text of gmsh's script language draws.
/// \param size  of the cells, in the unit of the drawing
/// \throws Error  where gmsh is missing or cannot mesh it, with gmsh's reason
/// \throws CellSizeError  for a size that memory does not allow
Mesh mesh_drawing(const std::string& script, int dim, double size);

}  // namespace perilink
