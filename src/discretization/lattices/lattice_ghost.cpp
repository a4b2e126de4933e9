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

GhostGrid fill_grid(const LatticeInput& input, const Lattice& lattice, const Box& bounds) {
  const int dim = lattice.dim;
  const bool hexagonal = lattice.pattern == Pattern::hexagonal;
  // Round-off must not add a step if the horizon is a multiple of the step.
  const auto margin =
      static_cast<Index>(std::ceil(input.horizon / lattice.step[0] * (1.0 - horizon_tolerance)));
  std::array<Index, 3> count{1, 1, 1};
  for (int axis = 0; axis < dim; ++axis) {
    const double extent = bounds.upper[axis] - bounds.lower[axis] + 2 * margin * lattice.step[0];
    count[axis] = static_cast<Index>(std::ceil(extent / lattice.step[axis])) + 1;
  }
  GhostGrid grid;
  grid.solid.dim = dim;
  for (Index k = 0; k < count[2]; ++k) {
    for (Index j = 0; j < count[1]; ++j) {
      const double shift = hexagonal && j % 2 == 1 ? 0.5 : 0.0;
      // Starts at 0, because shifted rows have a ghost at this distance too.
      for (Index i = 0; i <= count[0]; ++i) {
        if (lattice.pattern == Pattern::face_centred && (i + j + k) % 2 != 0) continue;
        const Vector3 point = {
            bounds.lower[0] + (i - margin - 0.5 + shift) * lattice.step[0],
            hexagonal ? bounds.lower[1] - margin * lattice.step[0] + j * lattice.step[1]
                      : bounds.lower[1] + (j - margin) * lattice.step[1],
            bounds.lower[2] + (k - margin) * lattice.step[2]};
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
