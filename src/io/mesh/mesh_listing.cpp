#include "io/mesh/mesh_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// More nodes would overflow the 32-bit numbers of bonds at usual horizons.
constexpr std::size_t most_nodes = 30'000'000;

/// Two-dimensional meshes lie in a plane of constant z to this fraction of their extent.
constexpr double flatness = 1e-9;

[[noreturn]] void refuse(const std::string& path, const std::string& fault,
                         const std::string& advice) {
  throw InputError({path, 0, ""}, fault, advice);
}

int dim_of(CellShape shape) { return properties_of(shape).dim; }

/// Finds nodes by tag.
class NodeTable {
 public:
  NodeTable(const MeshListing& listing, const std::string& path) : path_(path) {
    const auto count = static_cast<Index>(listing.node_tags.size());
    sorted_.reserve(listing.node_tags.size());
    for (Index i = 0; i < count; ++i) sorted_.emplace_back(listing.node_tags[i], i);
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

void check_dimension(const MeshListing& listing, const std::string& path, int dim) {
  int largest = 0;
  for (const CellShape shape : listing.shapes) largest = std::max(largest, dim_of(shape));
  if (listing.node_tags.empty() || listing.shapes.empty()) {
    refuse(path, "holds no mesh: it has no nodes or no elements",
           "mesh the geometry before saving it: gmsh FILE.geo -2 (or -3)");
  }
  if (largest > dim) {
    refuse(path, "holds solid cells, but the body has two dimensions",
           "set problem = \"three_dimensional\" in [body], or mesh the surface only: gmsh -2");
  }
  if (largest == dim) return;
  if (dim == 2) {
    refuse(path, "holds no triangles or quadrilaterals", "mesh the surface: gmsh FILE.geo -2");
  }
  refuse(
      path, "holds no tetrahedra or hexahedra, but the body has three dimensions",
      "mesh the volume: gmsh FILE.geo -3; or set problem = \"plane_stress\" in [body]. Where the "
      "geometry has physical groups, the volume needs one too");
}

/// Turns a listing into a mesh.
class MeshMaker {
 public:
  MeshMaker(MeshListing& listing, const std::string& path, int dim)
      : listing_(listing), path_(path) {
    mesh_.dim = dim;
  }

  Mesh make() {
    add_positions();
    add_elements();
    listing_.corners = {};  // frees memory
    listing_.element_tags = {};
    add_groups();
    if (mesh_.dim == 2) find_plane();
    add_notes();
    return std::move(mesh_);
  }

 private:
  void add_positions();
  std::vector<double> rank_nodes() const;
  void add_elements();
  std::vector<Index>* list_of(int dim);
  void turn_diagonal(std::span<const Index> corners, std::vector<Index>& parts) const;
  void add_groups();
  void find_plane();
  void add_notes();

  const double* node(Index i) const {
    return listing_.coordinates.data() + 3 * static_cast<std::size_t>(i);
  }

  MeshListing& listing_;
  const std::string& path_;
  Mesh mesh_;
  std::vector<Index> nodes_of_element_;       ///< as MeshListing::corners
  std::vector<Index> first_;                  ///< per element, in the list of its dimension
  std::vector<std::uint8_t> parts_;           ///< per element: parts in that list
  std::map<CellShape, std::size_t> divided_;  ///< numbers of divided cells
};

void MeshMaker::add_positions() {
  const std::size_t count = listing_.node_tags.size();
  if (count > most_nodes) {
    refuse(path_, fmt::format("has {} nodes", count),
           fmt::format("at most {} are possible: mesh with larger cells", most_nodes));
  }
  mesh_.positions.reserve(count * mesh_.dim);
  for (std::size_t i = 0; i < count; ++i) {
    const double* x = node(static_cast<Index>(i));
    mesh_.positions.insert(mesh_.positions.end(), x, x + mesh_.dim);
  }
}

/// Returns the mesh's list for elements of a dimension; none for points.
std::vector<Index>* MeshMaker::list_of(int dim) {
  return dim == mesh_.dim       ? &mesh_.cells
         : dim == mesh_.dim - 1 ? &mesh_.facets
         : dim == 1             ? &mesh_.lines
                                : nullptr;
}

/// Takes the other diagonal of a quadrilateral whose triangles overlap or have no area, because a
/// corner is on or within the line between its neighbours.
void MeshMaker::turn_diagonal(std::span<const Index> corners, std::vector<Index>& parts) const {
  const auto last = std::span(parts).last(6);
  const auto areas = [&] {
    return std::pair(signed_volume(mesh_.positions, 2, last.first(3)),
                     signed_volume(mesh_.positions, 2, last.last(3)));
  };
  constexpr double flattest = 1e-9;
  const auto [one, other] = areas();
  if (std::min(one / other, other / one) > flattest) return;
  const std::array<Index, 6> before{last[0], last[1], last[2], last[3], last[4], last[5]};
  const auto start = std::find(corners.begin(), corners.end(), last[0]) - corners.begin();
  const auto at = [&](std::ptrdiff_t k) { return corners[(start + k) % 4]; };
  const std::array<Index, 6> turned{at(1), at(2), at(3), at(1), at(3), at(0)};
  std::copy(turned.begin(), turned.end(), last.begin());
  const auto [new_one, new_other] = areas();
  if (!(new_one * new_other > 0.0)) std::copy(before.begin(), before.end(), last.begin());
}

/// Ranks the nodes by their coordinate along a direction that no usual row of nodes is normal to.
/// The diagonals of a regular mesh are then parallel.
std::vector<double> MeshMaker::rank_nodes() const {
  std::vector<double> rank;
  if (std::ranges::none_of(listing_.shapes, [](CellShape shape) {
        return properties_of(shape).corners > dim_of(shape) + 1;
      })) {
    return rank;
  }
  rank.reserve(listing_.node_tags.size());
  for (Index i = 0; i < static_cast<Index>(listing_.node_tags.size()); ++i) {
    rank.push_back(node(i)[0] + 0.62 * node(i)[1] + 0.39 * node(i)[2]);
  }
  return rank;
}

void MeshMaker::add_elements() {
  const auto count = static_cast<std::size_t>(listing_.num_elements());
  const std::vector<double> rank = rank_nodes();
  const NodeTable table(listing_, path_);
  std::vector<std::uint8_t> grouped(count, 0);
  for (const MeshListing::Group& group : listing_.groups) {
    for (const Index e : group.elements) grouped[e] = 1;
  }
  nodes_of_element_.reserve(listing_.corners.size());
  for (std::size_t e = 0, begin = 0; e < count; ++e) {
    const CellShape shape = listing_.shapes[e];
    const auto& [plural, dim, width, sides] = properties_of(shape);
    const bool is_cell = dim == mesh_.dim;
    const bool used = is_cell || grouped[e] != 0;
    std::vector<Index>* list = used ? list_of(dim) : nullptr;
    for (int k = 0; k < width; ++k, ++begin) {
      nodes_of_element_.push_back(used ? table.find(listing_.corners[begin]) : no_index);
    }
    const std::span<const Index> corners = std::span(nodes_of_element_).last(width);
    first_.push_back(list == nullptr ? 0 : static_cast<Index>(list->size()) / (dim + 1));
    parts_.push_back(0);  // at most six
    if (list == nullptr) continue;
    const std::size_t before = list->size();
    divide(shape, corners, rank, *list);
    if (is_cell && shape == CellShape::quadrilateral && list->size() == before + 6) {
      turn_diagonal(corners, *list);
    }
    parts_.back() = static_cast<std::uint8_t>((list->size() - before) / (dim + 1));
    if (!is_cell) continue;
    mesh_.cell_tags.insert(mesh_.cell_tags.end(), parts_.back(), listing_.element_tags[e]);
    if (width > dim + 1) ++divided_[shape];
  }
}

void MeshMaker::add_groups() {
  std::vector<std::size_t> begin(1, 0);
  begin.reserve(static_cast<std::size_t>(listing_.num_elements()) + 1);
  for (const CellShape shape : listing_.shapes) {
    begin.push_back(begin.back() + properties_of(shape).corners);
  }
  for (MeshListing::Group& listed : listing_.groups) {
    MeshGroup group{std::move(listed.name), listed.dim, {}, {}};
    const bool has_list = list_of(listed.dim) != nullptr;
    group.elements.reserve(listed.elements.size());
    for (const Index e : listed.elements) {
      group.points.insert(group.points.end(), nodes_of_element_.begin() + begin[e],
                          nodes_of_element_.begin() + begin[e + 1]);
      for (Index k = 0; has_list && k < parts_[e]; ++k) group.elements.push_back(first_[e] + k);
    }
    std::vector<Index>& points = group.points;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    mesh_.groups.push_back(std::move(group));
  }
}

/// Refuses two-dimensional meshes that are not plane, and marks groups that leave their plane.
void MeshMaker::find_plane() {
  if (mesh_.cells.empty()) refuse(path_, "holds only collapsed cells", "write the mesh again");
  double lower = INFINITY, upper = -INFINITY, extent = 0.0;
  const double* first = node(mesh_.cells.front());
  for (const Index point : mesh_.cells) {
    const double* x = node(point);
    lower = std::min(lower, x[2]);
    upper = std::max(upper, x[2]);
    extent = std::max({extent, std::abs(x[0] - first[0]), std::abs(x[1] - first[1])});
  }
  const double tolerance = flatness * extent;
  if (upper - lower > tolerance) {
    refuse(path_, fmt::format("is not a plane mesh: z is from {:.6g} to {:.6g}", lower, upper),
           "draw two-dimensional bodies in the plane of x and y");
  }
  for (MeshGroup& group : mesh_.groups) {
    group.off_plane =
        group.dim > 0 && std::any_of(group.points.begin(), group.points.end(), [&](Index point) {
          const double z = node(point)[2];
          return std::abs(z - lower) > tolerance;
        });
  }
}

void MeshMaker::add_notes() {
  mesh_.notes = std::move(listing_.notes);
  for (const auto& [shape, count] : divided_) {
    mesh_.notes.push_back(fmt::format("{}: {} {} are divided into {}", path_, count,
                                      properties_of(shape).plural,
                                      mesh_.dim == 2 ? "triangles" : "tetrahedra"));
  }
  if (!listing_.second_order[mesh_.dim]) return;
  mesh_.notes.push_back(
      fmt::format("{}: cells of second order count as cells of first order: nodes between their "
                  "corners are left out, and curved edges become straight",
                  path_));
}

}  // namespace

Mesh make_mesh(MeshListing listing, const std::string& path, int dim) {
  check_dimension(listing, path, dim);
  return MeshMaker(listing, path, dim).make();
}

}  // namespace perilink
