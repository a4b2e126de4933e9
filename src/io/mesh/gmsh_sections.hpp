#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh/gmsh_cursor.hpp"
#include "io/mesh/mesh_listing.hpp"

namespace perilink {

/// Dimension and tag of an entity or of a physical group.
using GmshKey = std::pair<int, int>;

/// Contents of a .msh file; its groups are not yet named.
struct GmshSections {
  MeshListing listing;
  std::map<GmshKey, std::string> names;            ///< by physical group
  std::map<GmshKey, std::vector<Index>> elements;  ///< by physical group
};

/// Kind of an element with its number of nodes, the first of which are its corners.
struct GmshType {
  CellShape shape;
  int nodes;
};

/// Returns the kind of element of gmsh's number, or refuses the file.
GmshType gmsh_type(const GmshCursor& file, int number);

/// Adds an element, whose tag and nodes come next in the file.
/// \param read_tag  reads one tag of a node
template <class ReadTag>
void add_gmsh_element(const GmshType& type, std::int64_t tag, const ReadTag& read_tag,
                      MeshListing& listing) {
  const int corners = properties_of(type.shape).corners;
  listing.shapes.push_back(type.shape);
  listing.element_tags.push_back(tag);
  for (int k = 0; k < corners; ++k) listing.corners.push_back(read_tag());
  for (int k = corners; k < type.nodes; ++k) read_tag();
  if (type.nodes > corners) listing.second_order[properties_of(type.shape).dim] = true;
}

/// Reads section $Nodes of version 2.
void read_nodes_2(GmshCursor& file, GmshSections& sections);

/// Reads section $Elements of version 2. An element that the file repeats for each of its physical
/// groups is added once.
void read_elements_2(GmshCursor& file, GmshSections& sections);

/// Reads a .msh file of version 4.1, 2.2 or 2.1.
/// - Elements may have any order.
/// - Partitioned meshes are refused; sections of results are skipped.
/// - A group without a name is named by its number. Groups are sorted by dimension and tag; groups
///   of equal dimension and name are merged.
/// \param path  for messages
/// \throws InputError
MeshListing read_gmsh(std::string_view bytes, const std::string& path);

}  // namespace perilink
