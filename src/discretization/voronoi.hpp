#pragma once

#include <vector>

#include "discretization/particles.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Volume of the Voronoi cell of every particle within its body: of the points of the triangles or
/// tetrahedra that are nearer to it than to any other particle (Nikravesh 2017, Eq. 3.53)
/// [length^3]. The volumes add up to that of the body, whatever its shape and whether or not its
/// cells are Delaunay's.
/// \param cells      their vertices are the particles
/// \param thickness  two-dimensional bodies only [length]
std::vector<double> voronoi_volumes(const Particles& particles, const Simplices& cells,
                                    double thickness);

}  // namespace perilink
