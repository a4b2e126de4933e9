#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "discretization/hosts/fill_hosts.hpp"
#include "discretization/meshes/cell_search.hpp"
#include "discretization/meshes/mesh_overlap.hpp"

namespace perilink {
namespace {

std::vector<Index> all_cells(const Mesh& mesh) {
  std::vector<Index> cells(static_cast<std::size_t>(mesh.num_cells()));
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

/// Triangles or tetrahedra with a node at each corner and, for order 2, in the middle of each edge.
class MeshCells {
 public:
  MeshCells(const Mesh& mesh, int order, double tolerance)
      : mesh_(mesh), order_(order), search_(mesh, all_cells(mesh), tolerance) {
    num_nodes_ = mesh.num_points();
    if (order == 1) return;
    std::map<std::pair<Index, Index>, Index> nodes;
    for (Index cell = 0; cell < size(); ++cell) {
      for (int edge = 0; edge < num_edges(); ++edge) {
        const auto [a, b] = ends(edge);
        const auto [low, high] = std::minmax({point(cell, a), point(cell, b)});
        const auto [node, is_new] = nodes.try_emplace({low, high}, num_nodes_);
        if (is_new) ++num_nodes_;
        on_edges_.push_back(node->second);
      }
    }
  }

  int dim() const { return mesh_.dim; }
  Index size() const { return mesh_.num_cells(); }
  Index num_nodes() const { return num_nodes_; }
  int num_corners() const { return mesh_.dim + 1; }
  int corner(int number) const { return number; }
  int nodes_per_cell() const { return num_corners() + (order_ == 2 ? num_edges() : 0); }

  template <class Visit>
  void for_each_around(std::span<const double> point, Visit visit) const {
    search_.for_each_around(point, visit);
  }
  bool is_within(Index cell, std::span<const double> point) const {
    return search_.is_within(cell, point);
  }

  Index node(Index cell, int local) const {
    if (local < num_corners()) return point(cell, local);
    return on_edges_[static_cast<std::size_t>(cell) * num_edges() + local - num_corners()];
  }

  double coordinate(Index cell, int local, int axis) const {
    if (local < num_corners()) return position(cell, local, axis);
    const auto [a, b] = ends(local - num_corners());
    return 0.5 * (position(cell, a, axis) + position(cell, b, axis));
  }

  /// Returns the shape function of a node in barycentric coordinates L: L or L (2 L - 1) for a
  /// corner, 4 L_a L_b for the middle of an edge.
  double weight(Index cell, int local, std::span<const double> point) const {
    const auto part = [&](int corner) { return search_.height(cell, corner, point); };
    if (local < num_corners()) {
      const double own = part(local);
      return order_ == 1 ? own : own * (2.0 * own - 1.0);
    }
    const auto [a, b] = ends(local - num_corners());
    return 4.0 * part(a) * part(b);
  }

 private:
  int num_edges() const { return mesh_.dim == 2 ? 3 : 6; }
  /// Returns corners at the ends of an edge.
  static std::pair<int, int> ends(int edge) {
    constexpr std::array<std::pair<int, int>, 6> all = {
        {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    return all[edge];
  }
  Index point(Index cell, int corner) const {
    return mesh_.cells[static_cast<std::size_t>(cell) * num_corners() + corner];
  }
  double position(Index cell, int corner, int axis) const {
    return mesh_.positions[static_cast<std::size_t>(point(cell, corner)) * mesh_.dim + axis];
  }

  const Mesh& mesh_;
  int order_;
  CellSearch search_;
  Index num_nodes_ = 0;
  std::vector<Index> on_edges_;  ///< node on each edge of each cell
};

}  // namespace

Hosts hosts_on_mesh(const Particles& particles, std::span<const double> faces, const Mesh& mesh,
                    int order, double tolerance) {
  if (const auto overlap = find_overlap(mesh)) {
    throw std::invalid_argument(fmt::format(
        "the elements {} and {} overlap, so that both would constrain the same particles",
        mesh.tag_of((*overlap)[0]), mesh.tag_of((*overlap)[1])));
  }
  return fill_hosts(particles, faces, MeshCells(mesh, order, tolerance));
}

}  // namespace perilink
