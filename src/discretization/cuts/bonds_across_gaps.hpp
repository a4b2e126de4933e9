#pragma once

#include <span>

#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Removes bonds between solid particles that leave the body, such as bonds across a notch or
/// between two bodies. Bonds to ghosts stay.
/// \param solid      boxes whose union is the body; a single box needs no removal
/// \param tolerance  a bond this close to a face counts as inside [length]
/// \return number of removed bonds
Index remove_bonds_across_gaps(const Particles& particles, Bonds& bonds, std::span<const Box> solid,
                               double tolerance);

}  // namespace perilink
