#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Lets the bonds that cross a weak interface break by its own law, whatever their materials: such
/// that their breaking takes its fracture energy per area of the face,
///   G = s_c^2 / 2 sum over the bonds through a unit area of k xi^2,
/// the sum over the families of particles beside the face, away from the surface where there are
/// such ones: 1/2 sum k xi^2 |xi . m| / V. Soft ones begin to at the stretch that their tensile
/// strength asks for, as bonds_of_material() finds it for a material of mean constants. A draft
/// only counts the bonds.
/// \throws TooStrong  with the number of the interface behind those of the materials
void weaken_interfaces(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
