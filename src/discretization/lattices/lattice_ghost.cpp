#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice_parts.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

Lattice ghost_lattice(const LatticeInput& input, int dim) {
  Lattice lattice;
  lattice.pattern = input.pattern;
  lattice.surface = Surface::ghost;
  lattice.dim = dim;
  lattice.spacing = input.spacing;
  double step = input.spacing;
  if (input.pattern == Pattern::face_centred) step /= std::numbers::sqrt2;
  lattice.step = {step, step, dim == 3 ? step : 0.0};
  if (input.pattern == Pattern::hexagonal) lattice.step[1] = 0.5 * std::numbers::sqrt3 * step;
  lattice.cell_volume =
      lattice.step[0] * lattice.step[1] * (dim == 3 ? lattice.step[2] : input.thickness);
  if (input.pattern == Pattern::face_centred) lattice.cell_volume *= 2.0;
  return lattice;
}

/// Grid points in and around the body: solid particles and positions of the other points, row after
/// row, both sorted by (z, y, x).
struct GhostGrid {
  Particles solid;
  std::vector<double> others;
};

/// Points of a grid along an axis.
struct GridAxis {
  double first;  ///< coordinate of the first point [length]
  Index count;   ///< number of points
  Index margin;  ///< number of points before the body, of which as many follow it
};

/// Centres the cells on the body, so that turned and mirrored bodies have turned and mirrored
/// grids. The rows of hexagonal patterns alternate: their number is odd.
GridAxis grid_axis(const LatticeInput& input, const Lattice& lattice, const Box& bounds, int axis) {
  const double step = lattice.step[axis];
  const bool hexagonal = lattice.pattern == Pattern::hexagonal;
  const double cells = (bounds.upper[axis] - bounds.lower[axis]) / step + input.boundary_tolerance;
  const auto inside = hexagonal && axis == 1
                          ? 2 * static_cast<Index>(0.5 * cells) + 1
                          : std::max<Index>(1, static_cast<Index>(std::lround(cells)));
  // Round-off must not add a step if the horizon is a multiple of the step. Shifted rows reach half
  // a step farther.
  const auto margin =
      static_cast<Index>(std::ceil(input.horizon / step * (1.0 - horizon_tolerance))) + hexagonal;
  const double middle = 0.5 * (bounds.lower[axis] + bounds.upper[axis]);
  return {middle - (0.5 * static_cast<double>(inside - 1) + static_cast<double>(margin)) * step,
          inside + 2 * margin, margin};
}

GhostGrid fill_grid(const LatticeInput& input, const Lattice& lattice, const Box& bounds) {
  const int dim = lattice.dim;
  const bool hexagonal = lattice.pattern == Pattern::hexagonal;
  std::array<GridAxis, 3> axes{{{0.0, 1, 0}, {0.0, 1, 0}, {bounds.lower[2], 1, 0}}};
  for (int axis = 0; axis < dim; ++axis) axes[axis] = grid_axis(input, lattice, bounds, axis);
  GhostGrid grid;
  grid.solid.dim = dim;
  for (Index k = 0; k < axes[2].count; ++k) {
    for (Index j = 0; j < axes[1].count; ++j) {
      const bool shifted = hexagonal && (j - axes[1].margin) % 2 != 0;
      // Shifted rows have a point more.
      for (Index i = 0; i < axes[0].count + (shifted ? 1 : 0); ++i) {
        if (lattice.pattern == Pattern::face_centred && (i + j + k) % 2 != 0) continue;
        const Vector3 point = {axes[0].first + (i - (shifted ? 0.5 : 0.0)) * lattice.step[0],
                               axes[1].first + j * lattice.step[1],
                               axes[2].first + k * lattice.step[2]};
        const Index material = material_at(input, {point.data(), static_cast<std::size_t>(dim)});
        if (material != no_index) {
          add_particle(grid.solid, point, lattice.cell_volume, material, ParticleKind::solid);
        } else {
          grid.others.insert(grid.others.end(), point.begin(), point.begin() + dim);
        }
      }
    }
  }
  return grid;
}

}  // namespace

Body make_ghost_body(const LatticeInput& input, const Outline& outline) {
  Body body;
  body.lattice = ghost_lattice(input, outline.dim);
  GhostGrid grid = fill_grid(input, body.lattice, outline.bounds);
  const Csr near_solid = find_neighbors(grid.solid.positions, grid.others, outline.dim,
                                        input.horizon * (1.0 + horizon_tolerance));
  body.particles = std::move(grid.solid);
  for (Index ghost = 0; ghost < near_solid.rows(); ++ghost) {
    if (near_solid.row(ghost).empty()) continue;
    Vector3 point{};
    for (int axis = 0; axis < outline.dim; ++axis) {
      point[axis] = grid.others[static_cast<std::size_t>(ghost) * outline.dim + axis];
    }
    add_particle(body.particles, point, body.lattice.cell_volume, no_index, ParticleKind::ghost);
  }
  return body;
}

}  // namespace perilink
