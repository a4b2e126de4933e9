#pragma once

#include <Eigen/SparseCore>
#include <span>

#include "base/types.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Lower triangle of the stiffness matrix of state-based particles,
///   K = sum over bonds of d k n n' + sum over particles of c h h',
/// with h u the sum of the extensions of the particle's bonds, each times its secant d: the second
/// derivative of the energy (docs/theory/lattice_particles.md, section 6). Particles that share a
/// neighbour are coupled.
/// \param secants  as for assemble_stiffness
/// \throws std::length_error for more than 2^31 - 1 entries
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_state_stiffness(
    const Network& network, std::span<const double> secants, const Unknowns& unknowns);

}  // namespace perilink
