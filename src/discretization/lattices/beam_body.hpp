#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink {

/// Fills a beam with a row of particles along the middles of the boxes. Particles lie at each end
/// of a box. The spacing between these ends is uniform and at most the wanted one.
/// \throws std::invalid_argument if the boxes leave a gap along x, their middles differ in y, or
///     boxes of different heights overlap
Body make_beam_body(const LatticeInput& input);

}  // namespace perilink
