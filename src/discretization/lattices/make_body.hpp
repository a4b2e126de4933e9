#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Fills a body with particles. Conforming lattices have particles on the boundary; volumes are
/// integrals of the shape functions. Peri2D's grid (surface = ghost) is cell-centred in x, starts
/// on the lowest row and continues as ghosts for one horizon beyond the body.
/// \throws std::invalid_argument if the body is empty or its outline does not fit the lattice
Body make_body(const LatticeInput& input);

}  // namespace perilink
