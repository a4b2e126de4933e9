#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Fill-reducing order of the unknowns by nested dissection of the graph of the particles (METIS):
/// permutation[k] is the unknown that is eliminated k-th. The unknowns of one particle stay
/// together. Ordering particles instead of unknowns costs a quarter (2D) to a ninth (3D) of the
/// time and gives the supernodes whole particles.
std::vector<Index> order_by_particles(const SparseMatrix& lower, std::span<const Index> groups);

/// Inverse of a permutation: position[permutation[k]] = k.
std::vector<Index> invert(std::span<const Index> permutation);

}  // namespace perilink
