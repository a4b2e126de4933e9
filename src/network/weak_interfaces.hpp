#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Lets the bonds that cross a weak interface break by its own law, whatever their materials. Their
/// breaking takes its fracture energy per area of the face, G = s_c^2 / 2 times the sum of k xi^2
/// over the area. Soft ones begin to at the stretch that makes the force across the face peak at
/// its strength, by bonds_of_face() (docs/theory/softening.md, section 10).
/// \throws TooStrong  with the number of the interface behind those of the materials
void weaken_interfaces(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
