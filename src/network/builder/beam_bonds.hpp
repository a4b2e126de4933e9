#pragma once

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Builds a beam: frame elements along its axis between particles of one beam segment within the
/// horizon. Each has a share of the section (docs/theory/beams.md).
Network make_beam(const Body& body, const NetworkInput& input);

}  // namespace perilink
