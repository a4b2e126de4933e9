#pragma once

#include <span>

#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Takes out the bonds between solid particles that leave the body on their way: nothing holds the
/// flanks of a notch or two bodies together across the air between them. Bonds to ghosts stay.
/// \param solid      the body is the union of these boxes; one box leaves every bond
/// \param tolerance  a bond this close to a face runs along it, inside [length]
/// \return number of bonds taken out
Index remove_bonds_across_gaps(const Particles& particles, Bonds& bonds, std::span<const Box> solid,
                               double tolerance);

}  // namespace perilink
