#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "network/network.hpp"

/// \file
/// Quantities per particle for output.

namespace perilink {

/// Damage: the part of the stiffness that bonds have lost, weighted by the volumes at their
/// other ends, per particle [-]. Bars that yield are not damaged.
std::vector<double> particle_damage(const Network& network, const Csr& neighbourhoods,
                                    Secants secants);

/// The displacements without the rotations, shape (particles, dim).
/// \param motion  shape (particles, width)
std::vector<double> translations(const Network& network, std::span<const double> motion);

/// Rotations of the particles [-]: one column in two dimensions, three in three; empty where no
/// bond carries a moment.
std::vector<double> rotations(const Network& network, std::span<const double> motion);

/// Half of the energy of the bonds of each particle, and that of its state, per volume
/// [force/length^2].
/// \param motion  shape (particles, width)
std::vector<double> strain_energy_density(const Network& network, Secants secants,
                                          std::span<const double> motion);

/// Principal strains, largest first, of the least-squares displacement gradient over the intact
/// bonds of each particle; shape (particles, dim). Zero where the bonds do not span the space.
/// \param displacement  shape (particles, dim)
std::vector<double> principal_strains(const Network& network, const Csr& neighbourhoods,
                                      Secants secants, std::span<const double> displacement);

/// Principal strains of a shell within its faces, largest first, of that face where the largest is
/// larger, by the same rule; the third is zero. Shape (particles, 3).
std::vector<double> face_strains(const Network& network, const Csr& neighbourhoods, Secants secants,
                                 std::span<const double> motion);

}  // namespace perilink
