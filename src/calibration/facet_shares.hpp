#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "discretization/facets.hpp"

namespace perilink {

/// Makes the boundary forces of uniform strains such that pair forces can balance them, by the
/// least change of the shares that corners have in their facets.
///
/// Forces along bonds k_b xi (n.eps.n) n, collected at the particles as the symmetric tensors sum
/// k_b xi nnn, do no work on fields y of symmetric third-order tensors with nnn : (y(x + xi n) -
/// y(x)) = 0 for all x and n: the Killing tensors, symmetrised products of three rigid motions, 10
/// in two dimensions and 50 in three. So must the boundary forces. For polynomials up to the first
/// degree equal shares do it; where facets differ in size they miss those of the second and third
/// degree by the square of the spacing, and no weights at all would pass the patch test.
/// \param positions  where the particles are, shape (particles, dim) [length]
/// \param part_of    part of the body that each particle belongs to, from zero: each must balance
/// \param modulus    per material, to weigh facets between materials [force/length^2]
void balance_shares(Facets& facets, std::span<const double> positions,
                    std::span<const Index> part_of, std::span<const double> modulus);

}  // namespace perilink
