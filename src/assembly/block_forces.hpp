#pragma once

#include <span>

#include "base/block.hpp"
#include "network/network.hpp"

namespace perilink {

/// Computes the forces of all elements and elastic supports for block_width motions, see
/// internal_force().
/// \param motions  shape (particles, width, block_width)
/// \param forces   the same shape as `motions` [force]
void block_forces(const Network& network, Secants secants, std::span<const double> motions,
                  std::span<double> forces);

}  // namespace perilink
