#pragma once

#include <span>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"

/// \file
/// Linear triangles and tetrahedra with a body's particles as vertices.

namespace perilink {

/// Returns a conforming mesh of a lattice body.
/// - rectangular: two triangles per cell, with diagonals that alternate like a chessboard
/// - hexagonal: the triangles of the lattice, halved along vertical sides
/// - cubic: six tetrahedra around one diagonal of each cube (Kuhn 1960)
/// \param input  input of make_body() for this body
/// \throws std::invalid_argument for a body with ghosts and for the face-centred pattern, whose
///     tetrahedra do not fill a body with faces along the axes
Simplices triangulate(const LatticeInput& input, const Body& body);

/// Returns the volume of every cell: area times thickness in two dimensions [length^3].
/// \param positions  shape (particles, dim)
std::vector<double> cell_volumes(const Simplices& cells, std::span<const double> positions,
                                 double thickness);

/// Returns the integral of every particle's linear shape function [length^3].
std::vector<double> shape_integrals(const Simplices& cells, std::span<const double> positions,
                                    double thickness);

/// Returns every edge of the cells once. A truss of these edges has exactly the rigid motions of
/// the cells, because the edges of a simplex fix its shape.
Bonds edges_of(const Simplices& cells, const Particles& particles);

}  // namespace perilink
