#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// A row of particles along the axis of a beam, through the middles of the boxes. Where one of them
/// begins or ends there is a particle, and the spacing between these is even and at most the one
/// that is wanted. The boxes are as high as the beam.
/// \throws std::invalid_argument where the boxes leave a gap along x, their middles differ in y, or
///     boxes of different heights overlap
Body make_beam_body(const LatticeInput& input);

}  // namespace perilink
