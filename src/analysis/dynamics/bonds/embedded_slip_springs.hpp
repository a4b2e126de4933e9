#pragma once

#include <memory>

#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "network/network.hpp"

namespace perilink {

/// Adds slip springs between nodes of bars and their embedded points to the other elements of a
/// network. Embedded points have no motion of their own. The extension of a slip spring is the
/// motion of its node against the particles around its embedded point. Every particle computes its
/// own part of the force.
/// \param network  must outlive the result
/// \param others   all elements without embedded points; may be null
std::unique_ptr<ExplicitBonds> with_embedded_slip_springs(const Network& network,
                                                          std::unique_ptr<ExplicitBonds> others);

}  // namespace perilink
