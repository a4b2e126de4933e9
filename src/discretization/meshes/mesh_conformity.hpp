#pragma once

#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Refuses a mesh whose parts only touch: a vertex on the surface that lies on a facet of the
/// surface without being one of its corners (parts meshed apart, or joined by cells of different
/// size). Forces would not pass there as they do inside the body.
/// \throws std::invalid_argument  with the place
void refuse_unjoined_parts(const Particles& particles, const Facets& facets);

}  // namespace perilink
