#include "discretization/lattices/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "discretization/lattices/lattice_parts.hpp"

namespace perilink {
namespace {

using Point = PointGrid::Point;

void append(Simplices& cells, std::initializer_list<Index> vertices, Index material) {
  cells.vertices.insert(cells.vertices.end(), vertices);
  cells.material.push_back(material);
}

/// Splits a cube into six tetrahedra. Each path along the axes from the lower to the upper corner
/// gives the corners of one. Paths in odd orders of the axes have negative orientation.
void split_cube(const PointGrid& grid, const Point& corner, Index material, Simplices& cells) {
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::size_t k = 0; k < orders.size(); ++k) {
    Point at = corner;
    std::array<Index, 4> path{grid.particle(at)};
    for (std::size_t step = 0; step < 3; ++step) {
      ++at[static_cast<std::size_t>(orders[k][step])];
      path[step + 1] = grid.particle(at);
    }
    if (k >= 3) std::swap(path[1], path[2]);
    append(cells, {path[0], path[1], path[2], path[3]}, material);
  }
}

void split_square(const PointGrid& grid, const Point& corner, Index material, Simplices& cells) {
  const auto [i, j, k] = corner;
  const Index a = grid.particle({i, j, k}), b = grid.particle({i + 1, j, k});
  const Index c = grid.particle({i + 1, j + 1, k}), d = grid.particle({i, j + 1, k});
  if ((i + j) % 2 == 0) {
    append(cells, {a, b, c}, material);
    append(cells, {a, c, d}, material);
  } else {
    append(cells, {a, b, d}, material);
    append(cells, {b, c, d}, material);
  }
}

Simplices split_grid(const LatticeInput& input, const Body& body, const Box& bounds) {
  const Lattice& lattice = body.lattice;
  const PointGrid grid(lattice, bounds, body.particles);
  Simplices cells;
  cells.dim = lattice.dim;
  const Index layers = lattice.dim == 3 ? grid.size(2) - 1 : 1;
  for (Index k = 0; k < layers; ++k) {
    for (Index j = 0; j + 1 < grid.size(1); ++j) {
      for (Index i = 0; i + 1 < grid.size(0); ++i) {
        const Index material = cell_material(input, lattice, bounds, {i, j, k});
        if (material == no_index) continue;
        lattice.dim == 3 ? split_cube(grid, {i, j, k}, material, cells)
                         : split_square(grid, {i, j, k}, material, cells);
      }
    }
  }
  return cells;
}

/// Where a vertical side of the body begins at a row, its particle halves the base of a whole
/// triangle in the next strip. This triangle is split too.
Simplices split_hexagons(const LatticeInput& input, const Body& body, const Outline& outline) {
  Simplices whole;
  fill_conforming_hexagonal(input, body.lattice, outline, whole);
  const PointGrid grid(body.lattice, outline.bounds, body.particles);
  Simplices cells;
  for (Index number = 0; number < whole.size(); ++number) {
    const std::span<const Index> cell = whole.cell(number);
    const Index material = whole.material[number];
    bool split = false;
    for (std::size_t v = 0; v < 3 && !split; ++v) {
      const Index a = cell[v], b = cell[(v + 1) % 3], apex = cell[(v + 2) % 3];
      const Point from = grid.point_of(body.particles, a), to = grid.point_of(body.particles, b);
      if (from[1] != to[1] || std::abs(from[0] - to[0]) != 2) continue;
      const Index middle = grid.particle({(from[0] + to[0]) / 2, from[1], 0});
      if (middle == no_index) continue;
      append(cells, {a, middle, apex}, material);
      append(cells, {middle, b, apex}, material);
      split = true;
    }
    if (!split) append(cells, {cell[0], cell[1], cell[2]}, material);
  }
  return cells;
}

}  // namespace

Simplices triangulate(const LatticeInput& input, const Body& body) {
  if (body.lattice.surface == Surface::ghost) {
    throw std::invalid_argument("a ghost lattice has no cells to fill with elements");
  }
  if (input.pattern == Pattern::face_centred) {
    throw std::invalid_argument(
        "the tetrahedra of a face-centred lattice do not fill a body whose faces lie along the "
        "axes: use the pattern \"cubic\"");
  }
  const Outline outline =
      make_outline(input.solid, body.lattice.dim, input.boundary_tolerance * input.spacing);
  return input.pattern == Pattern::hexagonal ? split_hexagons(input, body, outline)
                                             : split_grid(input, body, outline.bounds);
}

std::vector<double> cell_volumes(const Simplices& cells, std::span<const double> positions,
                                 double thickness) {
  const int dim = cells.dim;
  std::vector<double> volumes;
  volumes.reserve(cells.material.size());
  for (Index number = 0; number < cells.size(); ++number) {
    const std::span<const Index> cell = cells.cell(number);
    std::array<Vector3, 3> side{};
    for (int s = 0; s < dim; ++s) {
      for (int axis = 0; axis < dim; ++axis) {
        side[s][axis] = positions[static_cast<std::size_t>(cell[s + 1]) * dim + axis] -
                        positions[static_cast<std::size_t>(cell[0]) * dim + axis];
      }
    }
    const auto& [a, b, c] = side;
    volumes.push_back(dim == 2 ? 0.5 * thickness * (a[0] * b[1] - a[1] * b[0])
                               : (a[0] * (b[1] * c[2] - b[2] * c[1]) +
                                  a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                  a[2] * (b[0] * c[1] - b[1] * c[0])) /
                                     6.0);
  }
  return volumes;
}

std::vector<double> shape_integrals(const Simplices& cells, std::span<const double> positions,
                                    double thickness) {
  std::vector<double> integrals(positions.size() / static_cast<std::size_t>(cells.dim), 0.0);
  const std::vector<double> volumes = cell_volumes(cells, positions, thickness);
  for (Index number = 0; number < cells.size(); ++number) {
    for (const Index i : cells.cell(number)) integrals[i] += volumes[number] / (cells.dim + 1);
  }
  return integrals;
}

Bonds edges_of(const Simplices& cells, const Particles& particles) {
  std::vector<std::pair<Index, Index>> pairs;
  for (Index number = 0; number < cells.size(); ++number) {
    const std::span<const Index> cell = cells.cell(number);
    for (std::size_t a = 0; a < cell.size(); ++a) {
      for (std::size_t b = a + 1; b < cell.size(); ++b)
        pairs.push_back(std::minmax(cell[a], cell[b]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Bonds edges;
  edges.dim = particles.dim;
  for (const auto& [first, second] : pairs) edges.append(particles, first, second);
  return edges;
}

}  // namespace perilink
