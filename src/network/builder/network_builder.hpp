#pragma once

#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Bonds, bars and ties of a body with their constants, corrected near surfaces as the body's
/// surface option asks (correct_surfaces).
/// - Bond: k = c V_i V_j / xi with the mean c of its ends; a ghost's c is zero, hence half
///   stiffness (Gerstle, Sau & Silling 2005, section 4). It breaks at the critical stretch of the
/// smaller fracture energy and mean micromodulus of its ends; a bond to a ghost at that of its
/// solid
///   end. It cannot break where either end is unbreakable.
/// - Micropolar bond: the same, and the bending stiffness 12 d V_i V_j / xi^3 with the mean d of
///   its ends. Ties and segments carry no moments.
/// - Tie: stiffness and critical stretch of a bond of its solid end,
///   k = c V_i V / max(xi, spacing / 10), V the volume of a particle inside the lattice. Where bars
///   share a node its ties are unbreakable as soon as those of one of the bars are.
/// - Segment: k = E A / L, yield strain f_y / E, cannot break.
/// Bonds that leave the body or cross a pre-crack are not made.
/// Ghosts that too few bonds hold are left out, and bars add particles: the network's particles,
/// not the body's, are the ones that count from here on.
/// \throws std::invalid_argument where a material is missing, the numbers of bars and of their
///         materials differ, or the horizon is too small for the lattice
Network build_network(const Body& body, const NetworkInput& input);

/// Particles that elements in fewer than dim independent directions hold: without a support they
/// move freely. Ascending.
std::vector<Index> find_loose_particles(const Network& network);

}  // namespace perilink
