#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "base/types.hpp"
#include "network/loaded_network.hpp"
#include "network/network.hpp"

namespace perilink {

/// Lower triangle of K = sum over elements of k n n' (trusses) or of k_m b_m b_m' over the modes of
/// a frame (network/frame.hpp) between its free ends (unknown by unknown), with the particles'
/// states where they have some (assembly/state_stiffness.hpp).
/// \param secants  present stiffness of each element as a fraction of the intact one; broken
///                 elements keep their place in the pattern (as zeros), so that the pattern does
///                 not change while bonds break
Eigen::SparseMatrix<double, Eigen::ColMajor, Index> assemble_stiffness(
    const Network& network, std::span<const double> secants, const Unknowns& unknowns);

/// f at load factor 1 on the unknowns: applied forces less the forces that the prescribed
/// displacements put on free particles. Size unknowns.count.
std::vector<double> assemble_right_hand_side(const Network& network,
                                             std::span<const double> secants,
                                             const Unknowns& unknowns, const Loads& loads);

/// The same from the forces that the prescribed displacements need, K of all particles times them.
/// \param driven  shape (particles, width) [force]; empty: none
std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    std::span<const double> driven);

/// Whether any prescribed displacement is not zero.
bool is_driven(const Unknowns& unknowns);

/// Particle of every unknown, size unknowns.count.
std::vector<Index> particle_of_unknown(const Unknowns& unknowns);

}  // namespace perilink
