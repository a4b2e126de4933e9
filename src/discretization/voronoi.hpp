#pragma once

#include <vector>

#include "discretization/particles.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Returns the volume of each particle's Voronoi cell within the body [length^3] (Nikravesh 2017,
/// Eq. 3.53). The cell contains the points of the mesh that are nearest to the particle. The
/// volumes add up to the body's volume for any shape, also if the mesh is not Delaunay.
/// \param cells      vertices are the particles
/// \param thickness  two-dimensional bodies only [length]
std::vector<double> voronoi_volumes(const Particles& particles, const Simplices& cells,
                                    double thickness);

}  // namespace perilink
