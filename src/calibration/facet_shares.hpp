#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "discretization/facets.hpp"

namespace perilink {

/// Changes nodal area fractions as little as possible so that pair forces can balance the boundary
/// forces of uniform strains.
///
/// Forces along bonds k_b xi (n.eps.n) n, collected at the particles as the symmetric tensors sum
/// k_b xi nnn, do no work on fields y of symmetric third-order tensors with nnn : (y(x + xi n) -
/// y(x)) = 0 for all x and n: the Killing tensors, symmetrised products of three rigid motions, 10
/// in two dimensions and 50 in three. The boundary forces must do no work on them either. Equal
/// fractions satisfy this for polynomials up to the first degree. Where facets differ in size,
/// equal fractions have errors of second order in the spacing for the second and third degree. No
/// weights would then pass the patch test.
/// \param positions  shape (particles, dim) [length]
/// \param part_of  connected part of the body of each particle, from zero; each part must balance
/// \param modulus  per material, weight of facets between materials [force/length^2]
void balance_shares(Facets& facets, std::span<const double> positions,
                    std::span<const Index> part_of, std::span<const double> modulus);

}  // namespace perilink
