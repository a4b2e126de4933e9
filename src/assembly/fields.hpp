#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "material/strain.hpp"
#include "network/network.hpp"

/// \file
/// Particle quantities for output.

namespace perilink {

/// Returns the damage per particle [-]: the lost fraction of the stiffness of its bonds, weighted
/// with the volumes at their other ends. Yielding of bars is not damage.
std::vector<double> particle_damage(const Network& network, const Csr& neighbourhoods,
                                    Secants secants);

/// Returns the displacements without the rotations, shape (particles, dim) [length].
/// \param motion  shape (particles, width)
std::vector<double> translations(const Network& network, std::span<const double> motion);

/// Returns the rotations of the particles [-]: one column in two dimensions, three in three. The
/// result is empty where no bond carries a moment.
std::vector<double> rotations(const Network& network, std::span<const double> motion);

/// Returns the strain energy density per particle [force/length^2]: half of the energy of its
/// bonds, and the energy of its state.
/// \param motion   shape (particles, width)
/// \param measure  green: truss bonds only
std::vector<double> strain_energy_density(const Network& network, Secants secants,
                                          std::span<const double> motion,
                                          Strain measure = Strain::small);

/// Returns the principal strains per particle, largest first, shape (particles, dim) [-]. They
/// belong to the least-squares displacement gradient over the intact bonds. Zero where the bonds do
/// not span the space.
/// \param displacement  shape (particles, dim)
std::vector<double> principal_strains(const Network& network, const Csr& neighbourhoods,
                                      Secants secants, std::span<const double> displacement,
                                      Strain measure = Strain::small);

/// Returns the principal strains within the faces of a shell, largest first, shape (particles, 3)
/// [-]. They are fitted as in principal_strains(), for the face with the larger first strain; the
/// third is zero.
/// \param motion  shape (particles, 6)
std::vector<double> face_strains(const Network& network, const Csr& neighbourhoods, Secants secants,
                                 std::span<const double> motion);

}  // namespace perilink
