#pragma once

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Lays the network of a sheet in the plane on its surface in space, flat or a cylinder of which x
/// runs around, with the top at x = 0 (docs/theory/shells.md): its particles move along three axes
/// and rotate about three, its bonds become ribbons that bend and twist, its facets turn with it.
/// \throws std::invalid_argument  where the sheet is longer than around the cylinder
void make_shell(const NetworkInput& input, Network& network);

}  // namespace perilink
