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

/// Returns the lower triangle of the stiffness matrix K between the unknowns. K is the sum over
/// elements of k n n' for trusses, or of k_m b_m b_m' over the modes of a frame
/// (network/frame.hpp). Particles with states add c h h', where h u is the sum of secant times
/// extension over the particle's bonds. So particles with a common neighbour are coupled
/// (docs/theory/lattice_particles.md, section 6).
/// \param secants  present stiffness of each element over the intact one; broken elements stay in
///                 the pattern as zeros, so that it is constant
/// \throws std::length_error for more than 2^31 - 1 entries
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(const Network& network,
                                                                       Secants secants,
                                                                       const Unknowns& unknowns);

/// Returns K u and the energy for displacements of all particles.
using InternalForceOf = std::function<InternalForce(std::span<const double> displacement)>;

/// Returns the right-hand side f on the unknowns at load factor 1, size unknowns.count. It is the
/// applied forces less the forces that prescribed displacements exert on free particles.
/// \param internal_of  called only if a prescribed displacement is not zero
std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    const InternalForceOf& internal_of);

/// Returns the right-hand side of a network with the given secants, see right_hand_side().
std::vector<double> assemble_right_hand_side(const Network& network, Secants secants,
                                             const Unknowns& unknowns, const Loads& loads);

}  // namespace perilink
