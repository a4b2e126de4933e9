#pragma once

#include <memory>

#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "network/network.hpp"

namespace perilink {

/// Adds slip springs between nodes of bars and their embedded points, and contact springs of
/// pre-cracks, to the other elements of a network. Embedded points have no motion of their own. The
/// extension of a spring is the motion of its first end against the particles around its embedded
/// point. Contact springs act in compression only. Every particle computes its own part of the
/// force.
/// \param network  must outlive the result
/// \param others   all elements without embedded points; may be null
std::unique_ptr<ExplicitBonds> with_embedded_slip_springs(const Network& network,
                                                          std::unique_ptr<ExplicitBonds> others);

}  // namespace perilink
