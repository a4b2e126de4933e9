#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/outline.hpp"

/// \file
/// Parts of make_body(), shared only by the sources lattice*.cpp.

namespace perilink {

/// Returns the number of dimensions, 2 or 3.
int dimension_of(Pattern pattern);

/// Returns a lattice of about the given spacing whose planes end on the body's bounding box.
Lattice conforming_lattice(const LatticeInput& input, const Box& bounds, double spacing);

/// Returns the number of steps across the bounding box along each axis; 0 along z in two
/// dimensions.
std::array<Index, 3> count_steps(const Lattice& lattice, const Box& bounds);

/// Checks that all faces of the body are planes of the lattice.
/// \throws std::invalid_argument for other faces; the message lists nearby spacings that fit
void check_fit(const LatticeInput& input, const Lattice& lattice, const Outline& outline);

/// Returns particles of rectangular, cubic and face-centred patterns, also on the boundary.
Particles fill_conforming_grid(const LatticeInput& input, const Lattice& lattice,
                               const Outline& outline);

/// Returns particles of the hexagonal pattern, also on the boundary.
/// \param triangles  set to the triangles between the rows; the vertices are the particles
Particles fill_conforming_hexagonal(const LatticeInput& input, const Lattice& lattice,
                                    const Outline& outline, Simplices& triangles);

/// Returns surface and material interfaces of a rectangular, cubic or face-centred lattice: faces
/// of its cells. Cells of a face-centred lattice are half cubes; their faces have two particles
/// each.
Facets grid_facets(const LatticeInput& input, const Lattice& lattice, const Outline& outline,
                   const Particles& particles);

/// Returns Peri2D's grid: solid particles, then ghosts.
Body make_ghost_body(const LatticeInput& input, const Outline& outline);

/// Returns the material of a point, no_index outside the body.
Index material_at(const LatticeInput& input, std::span<const double> point);

/// Returns the material at the centre of a cell of the lattice's grid, no_index outside the body.
/// \param cell  counted from the lower corner
Index cell_material(const LatticeInput& input, const Lattice& lattice, const Box& bounds,
                    const std::array<Index, 3>& cell);

/// Returns the coordinate of a lattice plane; the last one lies exactly on the boundary.
inline double plane(const Box& bounds, const Lattice& lattice, int axis, Index number,
                    Index num_steps) {
  return number == num_steps ? bounds.upper[axis]
                             : bounds.lower[axis] + lattice.step[axis] * number;
}

void add_particle(Particles& particles, const Vector3& point, double volume, Index material,
                  ParticleKind kind);

/// Particles at the points of a lattice. Points are counted in steps from the lower corner of the
/// body's bounding box (half steps along the rows of a hexagonal lattice).
class PointGrid {
 public:
  using Point = std::array<Index, 3>;

  PointGrid(const Lattice& lattice, const Box& bounds, const Particles& particles);

  /// Returns the number of points along an axis, one more than cells.
  Index size(int axis) const { return size_[axis]; }
  /// Returns the particle at a point, or no_index.
  Index particle(const Point& point) const { return particles_[slot(point)]; }
  Point point_of(const Particles& particles, Index i) const;

 private:
  std::size_t slot(const Point& point) const {
    return point[0] + static_cast<std::size_t>(size_[0]) *
                          (point[1] + static_cast<std::size_t>(size_[1]) * point[2]);
  }

  Vector3 lower_;
  Vector3 step_;
  Point size_;
  std::vector<Index> particles_;
};

}  // namespace perilink
