#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace perilink {

/// Dimension and tag of an entity or of a physical group.
using GmshKey = std::pair<int, int>;

/// Elements of one entity and one type.
struct GmshBlock {
  GmshKey entity;
  int type = 0;                     ///< gmsh's number: 1 line, 2 triangle, 4 tetrahedron, 15 point
  std::vector<std::int64_t> tags;   ///< tags that the elements have
  std::vector<std::int64_t> nodes;  ///< tags of their nodes, element after element
};

/// Contents of a .msh 4.1 file, unprocessed.
struct GmshSections {
  std::map<GmshKey, std::string> names;               ///< by physical group
  std::map<GmshKey, std::vector<int>> physical_tags;  ///< by entity
  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;  ///< [length], shape (nodes, 3)
  std::vector<GmshBlock> blocks;
};

/// Reads the sections of a file. Element types other than points, lines, triangles and tetrahedra
/// of first order are refused, and so are partitioned meshes. Sections of results are skipped.
/// \param path  for messages
/// \throws InputError
GmshSections read_gmsh_sections(std::string_view bytes, const std::string& path);

}  // namespace perilink
