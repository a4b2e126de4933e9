#include "discretization/lattices/lattice_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perilink {
namespace {

/// Steps that divide the extent evenly and come nearest to the wanted distance; on demand an even
/// number of them.
double even_step(const Box& bounds, int axis, double wanted, bool even_number = false) {
  const double extent = bounds.upper[axis] - bounds.lower[axis];
  if (even_number) return extent / (2.0 * std::max(1.0, std::round(0.5 * extent / wanted)));
  return extent / std::max(1.0, std::round(extent / wanted));
}

}  // namespace

int dimension_of(Pattern pattern) {
  return pattern == Pattern::rectangular || pattern == Pattern::hexagonal ? 2 : 3;
}

Lattice conforming_lattice(const LatticeInput& input, const Box& bounds, double spacing) {
  Lattice lattice;
  lattice.pattern = input.pattern;
  lattice.surface = input.surface;
  lattice.dim = dimension_of(input.pattern);
  // Calibrated bonds need a particle with an equal-sided neighbourhood at the corners of the body:
  // of a face-centred lattice one at all, of a hexagonal one none on the right angle of half a
  // triangle.
  const bool even_number = input.surface == Surface::calibrated;
  if (input.pattern == Pattern::face_centred) {
    const double half_cube = spacing / std::numbers::sqrt2;
    for (int axis = 0; axis < 3; ++axis) {
      lattice.step[axis] = even_step(bounds, axis, half_cube, even_number);
    }
    lattice.spacing = std::numbers::sqrt2 * lattice.step[0];
    // Every other point of the grid of half cubes carries a particle.
    lattice.cell_volume = 2.0 * lattice.step[0] * lattice.step[1] * lattice.step[2];
    return lattice;
  }
  lattice.step[0] = even_step(bounds, 0, spacing);
  lattice.spacing = lattice.step[0];
  const double rows =
      input.pattern == Pattern::hexagonal ? 0.5 * std::numbers::sqrt3 * lattice.spacing : spacing;
  lattice.step[1] = even_step(bounds, 1, rows, even_number && input.pattern == Pattern::hexagonal);
  lattice.cell_volume = lattice.step[0] * lattice.step[1];
  if (lattice.dim == 3) {
    lattice.step[2] = even_step(bounds, 2, spacing);
    lattice.cell_volume *= lattice.step[2];
  } else {
    lattice.cell_volume *= input.thickness;
  }
  return lattice;
}

std::array<Index, 3> count_steps(const Lattice& lattice, const Box& bounds) {
  std::array<Index, 3> count{};
  for (int axis = 0; axis < lattice.dim; ++axis) {
    count[axis] = static_cast<Index>(
        std::lround((bounds.upper[axis] - bounds.lower[axis]) / lattice.step[axis]));
  }
  return count;
}

Index material_at(const LatticeInput& input, std::span<const double> point) {
  const double tolerance = input.boundary_tolerance * input.spacing;
  for (std::size_t box = input.solid.size(); box-- > 0;) {
    if (input.solid[box].contains(point, tolerance)) return input.material[box];
  }
  return no_index;
}

void add_particle(Particles& particles, const Vector3& point, double volume, Index material,
                  ParticleKind kind) {
  for (int axis = 0; axis < particles.dim; ++axis) particles.positions.push_back(point[axis]);
  particles.volumes.push_back(volume);
  particles.material.push_back(material);
  particles.kind.push_back(kind);
}

}  // namespace perilink
