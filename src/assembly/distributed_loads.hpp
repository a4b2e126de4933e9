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
/// Loads that are spread over the surface or the volume, as forces on particles: the integral of
/// the load times the particle's shape function N_i (docs/theory/loads.md). `Loads::forces` has as
/// many components per particle as it was sized for; these functions add to the first dim of them.

namespace perilink {

/// Force per area [force/length^2] at a point of the surface with the outward unit normal there.
using SurfaceLoad = std::function<Vector3(std::span<const double> position, const Vector3& normal)>;
/// Force per volume [force/length^3] at a point.
using BodyLoad = std::function<Vector3(std::span<const double> position)>;

/// Adds the integral of N_i t over facets, N linear on edges and triangles, bilinear on rectangles,
/// by Gauss rules that are exact for t up to the third order on triangles and the fourth on the
/// others. Facets of face-centred lattices, rectangles of which only two corners are particles,
/// take t at those two.
/// \return the integral of |t| [force]
double add_surface_load(const Particles& particles, const Facets& facets,
                        std::span<const Index> members, const SurfaceLoad& load, Loads& loads);

/// What the particles of a region bear of a force that is spread over it evenly, in proportion:
/// volumes of the cells whose corners are all members, else areas of such facets of the surface
/// (then a uniform traction). Where these miss a member or there are no cells, its volume V_i.
/// \param cells    empty: a lattice of bonds, on whose faces volumes are in proportion to areas
/// \param members  the region; the shares of others mean nothing
/// \return per particle [length^3], of facets [length^2]
std::vector<double> force_shares(const Particles& particles, const Simplices& cells,
                                 const Facets& facets, std::span<const Index> members);

/// Adds b(x_i) V_i for the particles of a region: the rule of lattices.
void add_lumped_body_load(const Particles& particles, std::span<const Index> members,
                          const BodyLoad& load, Loads& loads);

/// Adds the integral of N_i b over the cells of a mesh for the particles of a region, N linear;
/// exact for b up to the third order on triangles and the second on tetrahedra.
/// \param is_member  size particles: nonzero for those that take their share
/// \param thickness  two-dimensional bodies only [length]; 1 in three dimensions
void add_cell_body_load(const Particles& particles, const Simplices& cells, double thickness,
                        std::span<const std::uint8_t> is_member, const BodyLoad& load,
                        Loads& loads);

}  // namespace perilink
