#pragma once

#include <span>
#include <vector>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"

/// \file
/// Linear triangles and tetrahedra on the particles of a body.

namespace perilink {

/// Conforming mesh of a lattice body: two triangles in each cell of a rectangular lattice, with
/// diagonals that alternate like the colours of a chessboard; the triangles of a hexagonal lattice,
/// halved along vertical sides; six tetrahedra around the same diagonal of each cube (Kuhn 1960).
/// \param input  what the body was made of
/// \throws std::invalid_argument for a body with ghosts and for the face-centred pattern, whose
///         tetrahedra do not fill a body with faces along the axes
Simplices triangulate(const LatticeInput& input, const Body& body);

/// Volume of every cell: area times thickness in two dimensions [length^3].
/// \param positions  shape (particles, dim)
std::vector<double> cell_volumes(const Simplices& cells, std::span<const double> positions,
                                 double thickness);

/// Integral of every particle's linear shape function over the cells around it [length^3].
std::vector<double> shape_integrals(const Simplices& cells, std::span<const double> positions,
                                    double thickness);

/// Every edge of the cells once. A truss of them moves rigidly exactly where the cells do, for the
/// edges of a simplex fix its shape.
Bonds edges_of(const Simplices& cells, const Particles& particles);

}  // namespace perilink
