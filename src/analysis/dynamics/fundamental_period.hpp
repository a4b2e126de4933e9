#pragma once

#include <span>
#include <vector>

#include "analysis/dynamics/inertia.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Returns the period of the slowest vibration of the intact network about its supports [time];
/// infinite without vibrations. It is T = 2 pi / omega of the smallest eigenvalue of K x = omega^2
/// M x, by the three-term conjugate gradients of Knyazev (2001). Loading times of explicit runs are
/// measured by this period.
///
/// The iteration uses internal forces and no matrix of the body. The preconditioner has the rigid
/// motions of some hundred subdomains. The result is exact to about 1e-7. Very slender bodies, in
/// which round-off of forces could change the third digit, are refused
/// (docs/theory/explicit_bonds.md, section 4).
/// \param free  rigid motions without resistance (free_motions), shape (particles, width); the
///              vibrations are orthogonal to them
/// \throws SolverError when parts can move freely, the body is too slender, or the iteration does
///     not converge
double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          std::span<const std::vector<double>> free = {});

}  // namespace perilink
