#pragma once

#include <cstdint>
#include <vector>

#include "network/network.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {

/// Returns the parts of a body that can shift or turn freely while all pre-cracks are open. These
/// are particles and pieces that cracks cut off, and parts with too few bonds to the rest. The
/// largest rigid part counts as held, also vertices of finite elements and embedded points of bars.
/// \param held  nonzero where a displacement is prescribed, shape (particles, width)
std::vector<Fragment> find_loose_parts(const Network& network,
                                       const std::vector<std::uint8_t>& held);

}  // namespace perilink
