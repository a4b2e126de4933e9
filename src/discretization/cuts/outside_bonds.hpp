#pragma once

#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Largest distance of a bond from a mesh body [spacings]. Sides of a hole are chords of its curve,
/// and so are bonds between its vertices. A bond of m spacings h leaves a hole of radius R by about
/// m^2 h^2 / (8 R), fewer spacings for finer meshes.
inline constexpr double allowed_excursion = 0.1;

/// Removes bonds that leave a mesh body: bonds farther than allowed_excursion from it, and bonds
/// across a void between opposite flanks, however narrow. Bonds far from the surface cost only a
/// test of their particles.
/// \param facets   all facets of the body's surface
/// \param spacing  mean edge of the mesh [length]
/// \return number of removed bonds
Index remove_bonds_outside(const Particles& particles, Bonds& bonds, const Facets& facets,
                           double spacing);

}  // namespace perilink
