#pragma once

#include <span>
#include <vector>

#include "assembly/network.hpp"
#include "base/csr.hpp"

/// \file
/// Quantities per particle for output.

namespace perilink {

/// Damage index 1 - (intact bonds weighted by their volume) / (all bonds), per particle.
std::vector<double> damage_index(const Network& network, const Csr& families,
                                 std::span<const double> secants);

/// Half of the energy of the bonds of each particle per volume [force/length^2].
std::vector<double> strain_energy_density(const Network& network, const Csr& families,
                                          std::span<const double> secants,
                                          std::span<const double> displacement);

/// Principal strains, largest first, of the least-squares displacement gradient over the intact
/// bonds of each particle; shape (particles, dim). Zero where the bonds do not span the space.
std::vector<double> principal_strains(const Network& network, const Csr& families,
                                      std::span<const double> secants,
                                      std::span<const double> displacement);

}  // namespace perilink
