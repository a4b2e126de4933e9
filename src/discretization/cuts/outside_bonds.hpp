#pragma once

#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// A bond may leave a body made of a mesh by this much on its way, in spacings. The sides of a hole
/// are chords of its curve, and so are bonds between its vertices: a bond of m spacings h leaves a
/// hole of radius R by about m^2 h^2 / (8 R), ever fewer spacings as the mesh gets finer.
inline constexpr double allowed_excursion = 0.1;

/// Takes out the bonds of a mesh body that leave it: those that are farther than allowed_excursion
/// from the body somewhere on their way, and those that cross a void, however narrow, whose flanks
/// face each other. Bonds far from the surface cost nothing but a look at their particles.
/// \param facets   all of the body's surface
/// \param spacing  between particles, mean edge of the mesh [length]
/// \return number of bonds taken out
Index remove_bonds_outside(const Particles& particles, Bonds& bonds, const Facets& facets,
                           double spacing);

}  // namespace perilink
