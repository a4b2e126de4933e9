#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Stiffnesses of bonds as if all materials had the constants of the first everywhere
/// [force/length]. Empty: bonds keep their own.
struct EvenBonds {
  std::vector<double> stiffness;
  std::vector<double> bending = {};  ///< empty where no bond carries a moment
  std::vector<double> modulus = {};  ///< Young's modulus over that of the materials [-]; empty: 1
};

/// Returns the bonds of the solid that cross a weak interface, ascending, without bonds that
/// pre-cracks cut. Particles on the face belong to the side for which softer bonds cross it. With
/// equal materials, particles in both regions belong to the second side, and particles on lines or
/// planes to the positive side.
std::vector<Index> bonds_across(const Body& body, const NetworkInput& input,
                                const WeakInterface& face, const Network& network);

/// Sets the law of the bonds that cross weak interfaces, independent of their materials. Breaking
/// releases the interface's fracture energy per area: G = s_c^2 / 2 times the sum of k xi^2 over
/// the area. Softening bonds soften from the stretch at which the force across the face reaches the
/// interface's strength, see bonds_of_face(). Stretches vary along the face with the stiffness of
/// bonds (docs/theory/softening.md, section 10).
/// \throws TooStrong with the number of the interface after the materials
void weaken_interfaces(const Body& body, const NetworkInput& input, const EvenBonds& even,
                       Network& network);

}  // namespace perilink
