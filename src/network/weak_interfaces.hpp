#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Stiffnesses of every bond if all materials had the constants of the first one [force/length];
/// empty: bonds have those of their own materials.
struct EvenBonds {
  std::vector<double> stiffness;
  std::vector<double> bending = {};  ///< empty where no bond carries a moment
};

/// Bonds of the solid that cross a weak interface, without those that pre-cracks have cut,
/// ascending. Particles on the face are on the side that leaves the bonds of the softer material to
/// it. Where materials are the same, particles in both regions are on the second side, and those on
/// lines or planes on the positive one.
std::vector<Index> bonds_across(const Body& body, const NetworkInput& input,
                                const WeakInterface& face, const Network& network);

/// Lets the bonds that cross a weak interface break by its own law, whatever their materials. Their
/// breaking takes its fracture energy per area of the face, G = s_c^2 / 2 times the sum of k xi^2
/// over the area. Soft ones begin to at the stretch that makes the force across the face peak at
/// its strength, by bonds_of_face(). Where the stiffness of bonds varies along the face, stretches
/// do too (docs/theory/softening.md, section 10).
/// \throws TooStrong  with the number of the interface behind those of the materials
void weaken_interfaces(const Body& body, const NetworkInput& input, const EvenBonds& even,
                       Network& network);

}  // namespace perilink
