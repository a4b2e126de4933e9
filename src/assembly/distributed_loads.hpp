#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"
#include "discretization/simplices.hpp"
#include "network/loaded_network.hpp"

/// \file
/// Loads distributed over a surface or a volume, as forces on particles. A force is the integral of
/// the load times the particle's shape function N_i (docs/theory/loads.md). These functions add to
/// the first dim components per particle of `Loads::forces`, which may have more.

namespace perilink {

/// Force per area [force/length^2] at a point of the surface with its outward unit normal.
using SurfaceLoad = std::function<Vector3(std::span<const double> position, const Vector3& normal)>;
/// Force per volume [force/length^3] at a point.
using BodyLoad = std::function<Vector3(std::span<const double> position)>;

/// Adds the integral of N_i t over facets. N is linear on edges and triangles and bilinear on
/// rectangles. The Gauss rules are exact for t up to the third order on triangles and the fourth on
/// the others. Facets of face-centred lattices are rectangles with particles at two corners only;
/// they take t at those two corners.
/// \return the integral of |t| [force]
double add_surface_load(const Particles& particles, const Facets& facets,
                        std::span<const Index> members, const SurfaceLoad& load, Loads& loads);

/// Returns the relative shares of the particles of a region in a uniformly distributed force. The
/// shares are volumes of the cells whose corners are all members. Where these miss a member, they
/// are areas of such facets of the surface, as for a uniform traction. Where these miss a member
/// too, or without cells, they are the volumes V_i.
/// \param cells    empty for a lattice of bonds; on its faces volumes are proportional to areas
/// \param members  the region; shares of other particles are undefined
/// \return per particle [length^3], or [length^2] for facets
std::vector<double> force_shares(const Particles& particles, const Simplices& cells,
                                 const Facets& facets, std::span<const Index> members);

/// Adds b(x_i) V_i for the particles of a region, the rule of lattices.
void add_lumped_body_load(const Particles& particles, std::span<const Index> members,
                          const BodyLoad& load, Loads& loads);

/// Adds the integral of N_i b over the cells of a mesh for the particles of a region, with N
/// linear. It is exact for b up to the third order on triangles and the second on tetrahedra.
/// \param is_member  size particles: nonzero for members of the region
/// \param thickness  thickness of two-dimensional bodies [length]; 1 in three dimensions
void add_cell_body_load(const Particles& particles, const Simplices& cells, double thickness,
                        std::span<const std::uint8_t> is_member, const BodyLoad& load,
                        Loads& loads);

}  // namespace perilink
