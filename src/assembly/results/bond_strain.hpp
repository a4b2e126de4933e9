#pragma once

#include <span>

#include "base/csr.hpp"
#include "material/j2_plasticity.hpp"
#include "network/network.hpp"

namespace perilink {

/// Returns the strain at a particle [-] from the virial of its bonds, the sum of force times bond
/// vector. It is the uniform strain in which intact bonds would have that virial. In a uniform
/// strain it is exact for intact bonds, anywhere in the body and for any stiffnesses. If all bonds
/// have the secant a, it is a times that strain. Zero where the bonds do not resist every strain.
/// Contact springs, slip springs and bars do not count.
/// \param neighbourhoods  bonds of each particle (bonds_of_particles)
/// \param motion          shape (particles, width)
SymmetricTensor bond_strain(const Network& network, const Csr& neighbourhoods, Secants secants,
                            std::span<const double> motion, Index particle);

}  // namespace perilink
