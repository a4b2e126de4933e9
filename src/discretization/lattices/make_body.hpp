#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Fills a body with particles. Conforming lattices have particles on the boundary; volumes are
/// integrals of the shape functions. Peri2D's grid (surface = ghost) has a particle in the centre
/// of each cell, with the cells centred on the body, and continues as ghosts for one horizon beyond
/// it.
/// \throws std::invalid_argument if the body is empty or its outline does not fit the lattice
Body make_body(const LatticeInput& input);

}  // namespace perilink
