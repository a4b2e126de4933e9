#pragma once

#include <algorithm>
#include <span>

#include "base/csr.hpp"
#include "material/j2_plasticity.hpp"
#include "network/network.hpp"

namespace perilink {

/// Whether a pre-crack has broken a bond, which closes where it is compressed.
inline bool is_cut(const Network& network, Index element) {
  return std::ranges::binary_search(network.cut_elements, element);
}

/// The uniform strain in which the bonds of a particle, if they were intact, would have the virial
/// that they have as they are: sum of force times bond vector over all its bonds. In a uniform
/// strain it is that strain for intact bonds, anywhere in the body and for any stiffnesses, and a
/// times that strain where all of them have the secant a. Zero where the bonds do not resist every
/// strain. Ties, bars and open bonds across a pre-crack do not count.
/// \param families  bonds of each particle (bonds_of_particles)
/// \param motion    shape (particles, width)
SymmetricTensor bond_strain(const Network& network, const Csr& neighbourhoods, Secants secants,
                            std::span<const double> motion, Index particle);

}  // namespace perilink
