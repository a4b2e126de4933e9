#pragma once

#include <memory>

#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "network/network.hpp"

namespace perilink {

/// Ties between nodes of bars and their anchors, beside the other elements of a network. Anchors do
/// not move: the extension of a tie is that of its node against the particles of its anchor, and
/// every particle finds its own part of the force.
/// \param network  has to outlive the result
/// \param others   all elements that are not anchored; may be null
std::unique_ptr<ExplicitBonds> with_embedded_slip_springs(const Network& network,
                                                          std::unique_ptr<ExplicitBonds> others);

}  // namespace perilink
