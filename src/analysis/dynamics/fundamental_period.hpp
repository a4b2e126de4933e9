#pragma once

#include <span>
#include <vector>

#include "analysis/dynamics/inertia.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Period of the slowest vibration of the intact network about its supports [time], infinite where
/// nothing is free to vibrate: the smallest eigenvalue of K x = omega^2 M x by the
/// three-term conjugate gradients of Knyazev (2001), T = 2 pi / omega. What loading times of
/// explicit runs are measured by. Takes internal forces and no matrix of the body, of whatever
/// size; the preconditioner knows the rigid motions of some hundred boxes of particles. Exact to
/// about 1e-7; where round-off of the forces of very slender bodies could take the third digit, it
/// is refused (docs/theory/explicit_bonds.md, section 4).
/// \param free  rigid motions that nothing resists (free_motions), shape (particles, width): the
///              vibrations that are looked for have no part in them
/// \throws SolverError when parts can move freely, the body is too slender, or the iteration does
///     not settle
double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          std::span<const std::vector<double>> free = {});

}  // namespace perilink
