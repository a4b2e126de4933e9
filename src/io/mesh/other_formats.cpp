#include "io/mesh/other_formats.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/case/case_words.hpp"

namespace perilink {
std::string conversion_to_41(const std::string& path) {
  return fmt::format(
      "convert it, and name the new file: gmsh \"{}\" -save -format msh41 -o \"{}_41.msh\"", path,
      std::filesystem::path(path).replace_extension().string());
}

std::string conversion_to_first_order(const std::string& path) {
  if (is_geometry(path)) return "delete Mesh.ElementOrder and SetOrder from the script";
  return fmt::format(
      "convert it, and name the new file: echo 'Merge \"{}\"; SetOrder 1; Mesh.MshFileVersion = "
      "4.1; Save \"{}_order1.msh\";' > order1.geo && gmsh order1.geo -",
      path, std::filesystem::path(path).replace_extension().string());
}

std::string conversion_of_others(const std::string& path) {
  return fmt::format(
      "give a mesh of gmsh's format 4.1: gmsh FILE.geo -2 -format msh41 (-3 for solids). If this "
      "is "
      "a mesh of I-deas, MED, CGNS, VTK, Nastran or Medit, {}. Save other meshes as .unv, .med or "
      ".bdf first, and give geometries as .step, .brep or .geo",
      conversion_to_41(path));
}

}  // namespace perilink
