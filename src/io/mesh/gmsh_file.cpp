#include "io/mesh/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/files.hpp"
#include "io/mesh/gmsh_sections.hpp"

namespace perilink {
namespace {

/// More nodes would overflow the 32-bit numbers of bonds at usual horizons.
constexpr std::size_t most_nodes = 30'000'000;

/// Memory while a mesh is read, with the file [bytes per byte of the file]; 2.7 measured for a
/// million triangles, text and binary.
constexpr double memory_per_byte = 3.0;

/// Two-dimensional meshes lie in a plane of constant z to this fraction of their extent.
constexpr double flatness = 1e-9;

[[noreturn]] void refuse(const std::string& path, const std::string& fault,
                         const std::string& advice) {
  throw InputError({path, 0, ""}, fault, advice);
}

/// Finds nodes by tag.
class NodeTable {
 public:
  NodeTable(const GmshSections& sections, const std::string& path) : path_(path) {
    const auto count = static_cast<Index>(sections.node_tags.size());
    sorted_.reserve(sections.node_tags.size());
    for (Index i = 0; i < count; ++i) sorted_.emplace_back(sections.node_tags[i], i);
    std::sort(sorted_.begin(), sorted_.end());
    for (std::size_t i = 1; i < sorted_.size(); ++i) {
      if (sorted_[i].first == sorted_[i - 1].first) {
        refuse(path, fmt::format("has two nodes with the tag {}", sorted_[i].first), "");
      }
    }
  }

  Index find(std::int64_t tag) const {
    // Tags are nearly always 1, 2, 3, ...
    const std::int64_t guess = tag - sorted_.front().first;
    if (guess >= 0 && guess < static_cast<std::int64_t>(sorted_.size()) &&
        sorted_[guess].first == tag) {
      return sorted_[guess].second;
    }
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(tag, Index{0}));
    if (found == sorted_.end() || found->first != tag) {
      refuse(path_, fmt::format("has an element with the node {}, which is not in the file", tag),
             "the file is damaged: write the mesh again");
    }
    return found->second;
  }

 private:
  const std::string& path_;
  std::vector<std::pair<std::int64_t, Index>> sorted_;
};

void check_dimension(const GmshSections& sections, const std::string& path, int dim) {
  bool cells = false;
  for (const GmshBlock& block : sections.blocks) {
    cells = cells || (block.entity.first == dim && !block.nodes.empty());
    if (block.entity.first > dim) {
      refuse(path, "holds tetrahedra, but the body has two dimensions",
             "set problem = \"three_dimensional\" in [body], or mesh the surface only: gmsh -2");
    }
  }
  if (cells) return;
  if (dim == 2) refuse(path, "holds no triangles", "mesh the surface: gmsh FILE.geo -2");
  refuse(
      path, "holds no tetrahedra, but the body has three dimensions",
      "mesh the volume: gmsh FILE.geo -3; or set problem = \"plane_stress\" in [body]. Where the "
      "geometry has physical groups, the volume needs one too");
}

void add_positions(const GmshSections& sections, const std::string& path, Mesh& mesh) {
  const std::size_t count = sections.node_tags.size();
  if (count > most_nodes) {
    refuse(path, fmt::format("has {} nodes", count),
           fmt::format("at most {} are possible: mesh with larger cells", most_nodes));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double* x = sections.coordinates.data() + 3 * i;
    mesh.positions.insert(mesh.positions.end(), x, x + mesh.dim);
  }
}

/// Refuses two-dimensional meshes that are not plane. Nodes without elements are ignored.
void refuse_bent(const GmshSections& sections, const std::string& path, const Mesh& mesh) {
  double lower = INFINITY, upper = -INFINITY, extent = 0.0;
  const double* first =
      sections.coordinates.data() + 3 * static_cast<std::size_t>(mesh.cells.front());
  for (const std::vector<Index>* corners : {&mesh.cells, &mesh.facets}) {
    for (const Index point : *corners) {
      const double* x = sections.coordinates.data() + 3 * static_cast<std::size_t>(point);
      lower = std::min(lower, x[2]);
      upper = std::max(upper, x[2]);
      extent = std::max({extent, std::abs(x[0] - first[0]), std::abs(x[1] - first[1])});
    }
  }
  if (upper - lower > flatness * extent) {
    refuse(path, fmt::format("is not a plane mesh: z is from {:.6g} to {:.6g}", lower, upper),
           "draw two-dimensional bodies in the plane of x and y");
  }
}

using Groups = std::map<GmshKey, MeshGroup>;
using FirstTags = std::map<std::pair<int, std::string>, int>;  // by dimension and name

/// Returns the group of a physical tag, and adds it at first use. Tags of equal dimension and name
/// share a group.
MeshGroup& group_of(Groups& groups, FirstTags& first, const GmshSections& sections,
                    const GmshKey& key) {
  const auto found = sections.names.find(key);
  std::string name = found != sections.names.end() ? found->second : std::to_string(key.second);
  MeshGroup& group =
      groups[{key.first, first.try_emplace({key.first, name}, key.second).first->second}];
  group.dim = key.first;
  group.name = std::move(name);
  return group;
}

void add_elements(const GmshSections& sections, const std::string& path, Mesh& mesh) {
  const NodeTable table(sections, path);
  Groups groups;
  FirstTags first_tags;
  std::vector<Index> nodes;
  for (const GmshBlock& block : sections.blocks) {
    const int dim = block.entity.first;
    const auto tags = sections.physical_tags.find(block.entity);
    const bool grouped = tags != sections.physical_tags.end() && !tags->second.empty();
    if (dim < mesh.dim && !grouped) continue;
    nodes.clear();
    for (const std::int64_t tag : block.nodes) nodes.push_back(table.find(tag));
    const bool is_cell = dim == mesh.dim, is_facet = dim == mesh.dim - 1;
    std::vector<Index>* elements = is_cell    ? &mesh.cells
                                   : is_facet ? &mesh.facets
                                   : dim == 1 ? &mesh.lines
                                              : nullptr;
    const std::size_t width = static_cast<std::size_t>(dim) + 1;
    const auto first = static_cast<Index>(elements != nullptr ? elements->size() / width : 0);
    if (elements != nullptr) elements->insert(elements->end(), nodes.begin(), nodes.end());
    if (is_cell) mesh.cell_tags.insert(mesh.cell_tags.end(), block.tags.begin(), block.tags.end());
    if (!grouped) continue;
    std::set<MeshGroup*> distinct;
    for (const int tag : tags->second) {
      distinct.insert(&group_of(groups, first_tags, sections, {dim, tag}));
    }
    for (MeshGroup* group : distinct) {
      group->points.insert(group->points.end(), nodes.begin(), nodes.end());
      for (std::size_t k = 0; elements != nullptr && k < nodes.size() / width; ++k) {
        group->elements.push_back(first + static_cast<Index>(k));
      }
    }
  }
  for (auto& [key, group] : groups) {
    std::vector<Index>& points = group.points;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    mesh.groups.push_back(std::move(group));
  }
}

}  // namespace

Mesh parse_gmsh(std::string_view bytes, const std::string& path, int dim) {
  const GmshSections sections = read_gmsh_sections(bytes, path);
  check_dimension(sections, path, dim);
  Mesh mesh;
  mesh.dim = dim;
  add_positions(sections, path, mesh);
  add_elements(sections, path, mesh);
  if (dim == 2) refuse_bent(sections, path, mesh);
  return mesh;
}

Mesh read_gmsh_file(const std::string& path, int dim) {
  const std::string bytes = read_regular_file(path, SIZE_MAX, memory_per_byte);
  return parse_gmsh(bytes, path, dim);
}

}  // namespace perilink
