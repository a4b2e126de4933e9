#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/outline.hpp"

/// \file
/// Pieces of make_body(), shared by the sources lattice*.cpp only.

namespace perilink {

/// 2 or 3.
int dimension_of(Pattern pattern);

/// Lattice of about the given spacing whose planes end on the body's bounding box.
Lattice conforming_lattice(const LatticeInput& input, const Box& bounds, double spacing);

/// Number of steps of the lattice across the bounding box, along each axis (0 in the third axis of
/// two-dimensional bodies).
std::array<Index, 3> count_steps(const Lattice& lattice, const Box& bounds);

/// \throws std::invalid_argument where a face of the body lies between the planes of the lattice;
///         the message names spacings nearby that would fit
void check_fit(const LatticeInput& input, const Lattice& lattice, const Outline& outline);

/// Particles on the boundary, rectangular, cubic and face-centred patterns.
Particles fill_conforming_grid(const LatticeInput& input, const Lattice& lattice,
                               const Outline& outline);

/// The same for the hexagonal pattern.
/// \param triangles  on return the triangles between the rows, whose vertices are the particles
Particles fill_conforming_hexagonal(const LatticeInput& input, const Lattice& lattice,
                                    const Outline& outline, Simplices& triangles);

/// Surface and material interfaces of a rectangular, cubic or face-centred lattice: faces of the
/// cells of its grid (of a face-centred lattice half cubes, whose faces have two particles each).
Facets grid_facets(const LatticeInput& input, const Lattice& lattice, const Outline& outline,
                   const Particles& particles);

/// Peri2D's grid: solid particles, then ghosts.
Body make_ghost_body(const LatticeInput& input, const Outline& outline);

/// Material of a point, no_index outside the body.
Index material_at(const LatticeInput& input, std::span<const double> point);

/// The same at the middle of a cell of the lattice's grid, counted from the lower corner.
Index cell_material(const LatticeInput& input, const Lattice& lattice, const Box& bounds,
                    const std::array<Index, 3>& cell);

/// Coordinate of a plane of the lattice; the last one ends exactly on the boundary.
inline double plane(const Box& bounds, const Lattice& lattice, int axis, Index number,
                    Index num_steps) {
  return number == num_steps ? bounds.upper[axis]
                             : bounds.lower[axis] + lattice.step[axis] * number;
}

/// Appends a particle.
void add_particle(Particles& particles, const Vector3& point, double volume, Index material,
                  ParticleKind kind);

/// Particles at the points of a lattice, which are counted from the lower corner of the body's
/// bounding box in steps (half steps along the rows of a hexagonal lattice).
class PointGrid {
 public:
  using Point = std::array<Index, 3>;

  PointGrid(const Lattice& lattice, const Box& bounds, const Particles& particles);

  /// Points along an axis; cells are one fewer.
  Index size(int axis) const { return size_[axis]; }
  /// no_index: there is none.
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
