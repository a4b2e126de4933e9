#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Fills a body with particles: `conforming` puts particles on the boundary and gives each the
/// integral of its shape function as volume; Peri2D's grid (surface = ghost) is cell-centred in x,
/// starts on the lowest row and continues as ghosts for one horizon beyond the body.
/// \throws std::invalid_argument where the body is empty or its outline misses the lattice
Body make_body(const LatticeInput& input);

}  // namespace perilink
