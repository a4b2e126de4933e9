#include "discretization/meshes/mesh_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "discretization/facet_geometry.hpp"
#include "discretization/meshes/cell_corners.hpp"

namespace perilink {
namespace {

/// Allowed penetration of two cells over the smaller cell's longest edge. Meshes are written with
/// 16 digits, in single precision with 7.
constexpr double contact = 1e-6;

/// Edges with a smaller sine of their angle count as parallel and give no axis.
constexpr double parallel = 1e-9;

using Cell = CellCorners;

Cell cell_at(const Simplices& cells, std::span<const double> positions, Index number) {
  return {positions, cells.dim, cells.cell(number)};
}

/// Returns whether the projections of two cells on an axis overlap by at most the tolerance.
bool separates(const Vector3& axis, double length, const Cell& a, const Cell& b, double tolerance) {
  double lower[2] = {INFINITY, INFINITY}, upper[2] = {-INFINITY, -INFINITY};
  for (int side = 0; side < 2; ++side) {
    const Cell& cell = side == 0 ? a : b;
    for (int k = 0; k < cell.count; ++k) {
      // Relative to a corner, so that round-off scales with the size of the cells, not their
      // position.
      const double x = dot(axis, minus(cell.at[k], a.at[0]));
      lower[side] = std::min(lower[side], x);
      upper[side] = std::max(upper[side], x);
    }
  }
  return std::min(upper[0], upper[1]) - std::max(lower[0], lower[1]) <= tolerance * length;
}

bool separated_by_side(const Cell& of, const Cell& a, const Cell& b, double tolerance) {
  for (int k = 0; k < of.count; ++k) {
    const Vector3 axis = of.normal_of_side(k);
    if (separates(axis, norm(axis), a, b, tolerance)) return true;
  }
  return false;
}

bool separated_across_edges(const Cell& a, const Cell& b, double tolerance) {
  for (int i = 0; i < a.count; ++i) {
    for (int j = 0; j < i; ++j) {
      const Vector3 u = minus(a.at[i], a.at[j]);
      for (int k = 0; k < b.count; ++k) {
        for (int l = 0; l < k; ++l) {
          const Vector3 v = minus(b.at[k], b.at[l]);
          const Vector3 axis = cross(u, v);
          const double length = norm(axis);
          if (length <= parallel * norm(u) * norm(v)) continue;
          if (separates(axis, length, a, b, tolerance)) return true;
        }
      }
    }
  }
  return false;
}

/// Tests the axes normal to a side of one body or, in space, to an edge of each. Two convex bodies
/// overlap if none of these axes separates them (Gottschalk, Lin & Manocha 1996).
bool overlap(const Cell& a, const Cell& b) {
  const double tolerance = contact * std::min(a.size, b.size);
  if (separated_by_side(a, a, b, tolerance) || separated_by_side(b, a, b, tolerance)) return false;
  return a.count == 3 || !separated_across_edges(a, b, tolerance);
}

bool touch(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  }
  return true;
}

/// Tree of bounding boxes by bisection of the cells. A grid would be slow for cells of different
/// sizes.
class CellTree {
 public:
  explicit CellTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    build(0, 0, order_.size());
  }

  template <class Act>
  void visit(const Box& box, const Act& act) const {
    visit(0, 0, order_.size(), box, act);
  }

 private:
  static constexpr std::size_t leaf = 8;

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    Box all = boxes_[order_[begin]];
    for (std::size_t k = begin; k < end; ++k) {
      for (int a = 0; a < 3; ++a) {
        all.lower[a] = std::min(all.lower[a], boxes_[order_[k]].lower[a]);
        all.upper[a] = std::max(all.upper[a], boxes_[order_[k]].upper[a]);
      }
    }
    nodes_[node] = all;
    if (end - begin <= leaf) return;
    int widest = 0;
    for (int a = 1; a < 3; ++a) {
      if (all.upper[a] - all.lower[a] > all.upper[widest] - all.lower[widest]) widest = a;
    }
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](Index i, Index j) {
      return boxes_[i].lower[widest] + boxes_[i].upper[widest] <
             boxes_[j].lower[widest] + boxes_[j].upper[widest];
    });
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
  }

  template <class Act>
  void visit(std::size_t node, std::size_t begin, std::size_t end, const Box& box,
             const Act& act) const {
    if (!touch(nodes_[node], box)) return;
    if (end - begin <= leaf) {
      for (std::size_t k = begin; k < end; ++k) {
        if (touch(boxes_[order_[k]], box)) act(order_[k]);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    visit(2 * node + 1, begin, middle, box, act);
    visit(2 * node + 2, middle, end, box, act);
  }

  std::vector<Box> boxes_;  ///< per cell
  std::vector<Index> order_;
  std::vector<Box> nodes_;  ///< halves of node n: 2 n + 1 and 2 n + 2
};

std::vector<Index> cells_at_surface(const CellFaces& faces) {
  std::vector<Index> found;
  for (const auto& [inner, outer] : faces.cells) {
    if (outer == no_index) found.push_back(inner);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

std::optional<std::array<Index, 2>> find_overlap(const Simplices& cells,
                                                 std::span<const double> positions,
                                                 const CellFaces& faces) {
  std::vector<Box> boxes;
  for (Index c = 0; c < cells.size(); ++c) boxes.push_back(cell_at(cells, positions, c).box);
  const CellTree tree(std::move(boxes));
  const std::vector<Index> outer = cells_at_surface(faces);
  std::vector<Index> partner(outer.size(), no_index);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const Cell cell = cell_at(cells, positions, outer[k]);
    tree.visit(cell.box, [&](Index other) {
      if (other == outer[k] || (partner[k] != no_index && partner[k] < other)) return;
      if (overlap(cell, cell_at(cells, positions, other))) partner[k] = other;
    });
  }
  for (std::size_t k = 0; k < outer.size(); ++k) {
    if (partner[k] == no_index) continue;
    return std::array{std::min(outer[k], partner[k]), std::max(outer[k], partner[k])};
  }
  return std::nullopt;
}

std::optional<std::array<Index, 2>> find_overlap(const Mesh& mesh) {
  Simplices cells;
  cells.dim = mesh.dim;
  cells.vertices = mesh.cells;
  cells.material.assign(static_cast<std::size_t>(mesh.num_cells()), 0);
  for (Index cell = 0; cell < cells.size(); ++cell) {
    Index* last = cells.vertices.data() + static_cast<std::size_t>(cell + 1) * (mesh.dim + 1) - 1;
    if (signed_volume(mesh.positions, mesh.dim, cells.cell(cell)) < 0.0) std::swap(last[-1], *last);
  }
  return find_overlap(cells, mesh.positions, find_faces(cells, mesh.positions));
}

}  // namespace perilink
