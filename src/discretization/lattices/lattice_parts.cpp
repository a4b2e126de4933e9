#include "discretization/lattices/lattice_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perilink {
namespace {

/// Returns the step nearest to the wanted one that divides the extent evenly, on request into an
/// even number of steps.
double even_step(const Box& bounds, int axis, double wanted, bool even_number = false) {
  const double extent = bounds.upper[axis] - bounds.lower[axis];
  if (even_number) return extent / (2.0 * std::max(1.0, std::round(0.5 * extent / wanted)));
  return extent / std::max(1.0, std::round(extent / wanted));
}

/// Returns the row height of calibrated hexagonal lattices, whose number of rows is even. Where
/// materials of different stiffness meet, the number of rows below each face is even too, if rows
/// of about the wanted height allow it.
double height_of_paired_rows(const LatticeInput& input, const Box& bounds, double wanted) {
  constexpr double most_stretched = 0.05, same_plane = 1e-6;
  const double extent = bounds.upper[1] - bounds.lower[1], pairs = 0.5 * extent / wanted;
  const auto has_below = [&](double number, double height) {
    const double below = (height - bounds.lower[1]) / extent * number;
    return std::abs(below - std::round(below)) < same_plane;
  };
  const auto has_below_faces = [&](double number) {
    return std::all_of(input.solid.begin(), input.solid.end(), [&](const Box& box) {
      return has_below(number, box.lower[1]) && has_below(number, box.upper[1]);
    });
  };
  double found = std::max(1.0, std::round(pairs));
  if (!input.unlike_materials) return extent / (2.0 * found);
  double off = most_stretched * pairs;
  for (double number = 1.0; number < pairs + off; number += 1.0) {
    if (std::abs(number - pairs) > off || !has_below_faces(number)) continue;
    off = std::abs(number - pairs);
    found = number;
  }
  return extent / (2.0 * found);
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
  // Calibrated bonds need particles with equal-sided neighbourhoods at the corners of the body. A
  // face-centred lattice then has a particle at every corner. A hexagonal lattice has no particle
  // at the right angle of half a triangle.
  const bool even_number = input.surface == Surface::calibrated;
  if (input.pattern == Pattern::face_centred) {
    const double half_cube = spacing / std::numbers::sqrt2;
    for (int axis = 0; axis < 3; ++axis) {
      lattice.step[axis] = even_step(bounds, axis, half_cube, even_number);
    }
    lattice.spacing = std::numbers::sqrt2 * lattice.step[0];
    // Every second point of the grid of half cubes carries a particle.
    lattice.cell_volume = 2.0 * lattice.step[0] * lattice.step[1] * lattice.step[2];
    return lattice;
  }
  lattice.step[0] = even_step(bounds, 0, spacing);
  lattice.spacing = lattice.step[0];
  const double rows =
      input.pattern == Pattern::hexagonal ? 0.5 * std::numbers::sqrt3 * lattice.spacing : spacing;
  lattice.step[1] = even_number && input.pattern == Pattern::hexagonal
                        ? height_of_paired_rows(input, bounds, rows)
                        : even_step(bounds, 1, rows);
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

Index cell_material(const LatticeInput& input, const Lattice& lattice, const Box& bounds,
                    const std::array<Index, 3>& cell) {
  const Vector3 centre = {bounds.lower[0] + (cell[0] + 0.5) * lattice.step[0],
                          bounds.lower[1] + (cell[1] + 0.5) * lattice.step[1],
                          bounds.lower[2] + (cell[2] + 0.5) * lattice.step[2]};
  return material_at(input, {centre.data(), static_cast<std::size_t>(lattice.dim)});
}

PointGrid::PointGrid(const Lattice& lattice, const Box& bounds, const Particles& particles)
    : lower_(bounds.lower), step_(lattice.step), size_(count_steps(lattice, bounds)) {
  if (lattice.pattern == Pattern::hexagonal) {
    step_[0] *= 0.5;
    size_[0] *= 2;
  }
  for (Index& count : size_) ++count;
  particles_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], no_index);
  for (Index i = 0; i < particles.size(); ++i) particles_[slot(point_of(particles, i))] = i;
}

PointGrid::Point PointGrid::point_of(const Particles& particles, Index i) const {
  Point point{};
  const std::span<const double> x = particles.position(i);
  for (int axis = 0; axis < particles.dim; ++axis) {
    point[axis] = static_cast<Index>(std::lround((x[axis] - lower_[axis]) / step_[axis]));
  }
  return point;
}

}  // namespace perilink
