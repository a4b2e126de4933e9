#pragma once

#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Builds the bonds, bars and slip springs of a body, corrected near surfaces by the body's surface
/// option (correct_surfaces).
/// - Bond: k = c V_i V_j / xi with the mean c of its ends. A ghost has c = 0, hence half the
///   stiffness (Gerstle, Sau & Silling 2005, section 4). The critical stretch follows from the
///   smaller fracture energy and the mean micromodulus of its ends; next to a ghost, from its solid
///   end. A bond with an unbreakable end cannot break.
/// - Micropolar bond: in addition the bending stiffness 12 d V_i V_j / xi^3 with the mean d of its
///   ends. Slip springs and bar elements carry no moments.
/// - Slip spring: k = c V_i V / max(xi, spacing / 10), with V the volume of an interior particle.
///   Its c and critical stretch are those of a bond of its solid end. Where bars share a node, one
///   bar with unbreakable slip springs makes all of the node's unbreakable.
/// - Bar element: k = E A / L, yield strain f_y / E, cannot break.
///
/// Bonds do not leave the body or cross a pre-crack. Ghosts with too few bonds are left out, and
/// bars add particles. So use the network's particles, not the body's, afterwards.
/// \throws std::invalid_argument if a material is missing, the numbers of bars and of their
///     materials differ, or the horizon is too small for the lattice
Network build_network(const Body& body, const NetworkInput& input);

/// Returns the particles held by elements in fewer than dim independent directions, ascending.
/// Without a support they move freely.
std::vector<Index> find_loose_particles(const Network& network);

}  // namespace perilink
