#pragma once

#include <span>
#include <vector>

#include "analysis/inertia.hpp"
#include "assembly/network.hpp"
#include "assembly/unknowns.hpp"

namespace perilink {

/// Period of the slowest vibration of the intact network about its supports [time]: the smallest
/// eigenvalue of K x = omega^2 M x by inverse iteration on the factor of K, T = 2 pi / omega. What
/// loading times of explicit runs are measured by.
/// \param free  rigid motions that nothing resists (free_motions), shape (particles, width): the
///              vibrations that are looked for have no part in them
/// \throws SolverError when K is not positive definite, or the iteration does not settle to 1e-6
double fundamental_period(const Network& network, const Unknowns& unknowns, const Inertia& inertia,
                          int threads, std::span<const std::vector<double>> free = {});

}  // namespace perilink
