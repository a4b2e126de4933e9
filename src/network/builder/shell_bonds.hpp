#pragma once

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns the point in space of a point on the flat mid-surface [length].
/// \param radius  of the cylinder [length]; 0: flat
Vector3 point_on_shell(double x, double y, double radius);

/// Maps the network of a flat mid-surface to its surface in space (docs/theory/shells.md). The
/// surface is flat, or a cylinder with x around it and its top at x = 0. Particles get three
/// displacements and three rotations, bonds become shell bonds that bend and twist, and facets turn
/// with the surface.
/// \throws std::invalid_argument if the mid-surface is longer than the circumference of the
///     cylinder
void make_shell(const NetworkInput& input, Network& network);

}  // namespace perilink
