#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "assembly/internal_force.hpp"
#include "base/types.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"

namespace perilink {

/// Lower triangle of K = sum over elements of k n n' (trusses) or of k_m b_m b_m' over the modes of
/// a frame (network/frame.hpp) between its free ends (unknown by unknown). Particles with states
/// add c h h': h u is the sum of the extensions of the particle's bonds, each times its secant, so
/// that particles that share a neighbour are coupled (docs/theory/lattice_particles.md, section 6).
/// \param secants  present stiffness of each element as a fraction of the intact one; broken
///                 elements keep their place in the pattern (as zeros), so that the pattern does
///                 not change while bonds break
/// \throws std::length_error for more than 2^31 - 1 entries
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(const Network& network,
                                                                       Secants secants,
                                                                       const Unknowns& unknowns);

/// K u and the energy for displacements of all particles.
using InternalForceOf = std::function<InternalForce(std::span<const double> displacement)>;

/// f at load factor 1 on the unknowns: applied forces less the forces that the prescribed
/// displacements put on free particles. Size unknowns.count.
/// \param internal_of  asked only where a prescribed displacement is not zero
std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    const InternalForceOf& internal_of);

/// The same for a network.
std::vector<double> assemble_right_hand_side(const Network& network, Secants secants,
                                             const Unknowns& unknowns, const Loads& loads);

}  // namespace perilink
