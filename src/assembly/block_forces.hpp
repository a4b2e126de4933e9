#pragma once

#include <span>

#include "base/block.hpp"
#include "network/network.hpp"

namespace perilink {

/// Forces of all elements and elastic supports under many motions at once, see internal_force().
/// \param motions  shape (particles, width, block_width), as `forces`
void block_forces(const Network& network, Secants secants, std::span<const double> motions,
                  std::span<double> forces);

}  // namespace perilink
