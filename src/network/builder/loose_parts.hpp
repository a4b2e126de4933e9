#pragma once

#include <cstdint>
#include <vector>

#include "network/network.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {

/// Parts of a body that shift or turn freely while all pre-cracks are open: particles and pieces
/// that cracks cut off, and those that too few bonds hold to the rest. The largest rigid part
/// counts as held, as do vertices of finite elements and anchors of bars.
/// \param held  nonzero where a displacement is prescribed, shape (particles, width)
std::vector<Fragment> find_loose_parts(const Network& network,
                                       const std::vector<std::uint8_t>& held);

}  // namespace perilink
