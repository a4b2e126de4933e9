#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Orders unknowns for low fill, by nested dissection of the particle graph (METIS). Unknowns of
/// one particle stay adjacent. Ordering particles takes a quarter (2D) to a ninth (3D) of the time
/// of ordering unknowns, and gives supernodes whole particles.
/// \return permutation: permutation[k] is the unknown that is eliminated k-th
std::vector<Index> order_by_particles(const SparseMatrix& lower, std::span<const Index> groups);

/// Returns the inverse of a permutation: position[permutation[k]] = k.
std::vector<Index> invert(std::span<const Index> permutation);

}  // namespace perilink
