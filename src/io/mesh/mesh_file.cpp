#include "io/mesh/mesh_file.hpp"

#include <cctype>
#include <cstdint>
#include <filesystem>

#include "base/files.hpp"
#include "io/mesh/abaqus_file.hpp"
#include "io/mesh/gmsh_sections.hpp"
#include "io/mesh/mesh_listing.hpp"

namespace perilink {
namespace {

/// Memory while a mesh is read, with the file [bytes per byte of the file]; 3.5 to 4.6 measured for
/// a million triangles, text and binary.
constexpr double memory_per_byte = 4.6;

bool is_abaqus(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".inp";
}

}  // namespace

Mesh parse_mesh(std::string_view bytes, const std::string& path, int dim) {
  return make_mesh(is_abaqus(path) ? read_abaqus(bytes, path) : read_gmsh(bytes, path), path, dim);
}

Mesh load_mesh(const std::string& path, int dim) {
  const std::string bytes = read_regular_file(path, SIZE_MAX, memory_per_byte);
  return parse_mesh(bytes, path, dim);
}

}  // namespace perilink
