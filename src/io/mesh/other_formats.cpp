#include "io/mesh/other_formats.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace perilink {

std::string conversion_to_41(const std::string& path) {
  return fmt::format(
      "convert it, and name the new file: gmsh \"{}\" -save -format msh41 -o \"{}_41.msh\"", path,
      std::filesystem::path(path).replace_extension().string());
}

std::string conversion_of_others(const std::string& path) {
  return fmt::format(
      "meshes of gmsh (.msh) and Abaqus (.inp) are read. If this is a mesh of I-deas, MED, CGNS, "
      "VTK, Nastran or Medit, {}; for most other formats: meshio convert \"{}\" \"{}.msh\". Give "
      "geometries as .step, .brep or .geo",
      conversion_to_41(path), path, std::filesystem::path(path).replace_extension().string());
}

}  // namespace perilink
