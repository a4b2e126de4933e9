#pragma once

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// The bonds of a beam: frames along its axis between particles of one span within the horizon,
/// each with a share of the section (docs/theory/beams.md).
Network make_beam(const Body& body, const NetworkInput& input);

}  // namespace perilink
