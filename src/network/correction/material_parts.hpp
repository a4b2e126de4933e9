#pragma once

#include <functional>
#include <vector>

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// All of a body that has one stiffness, as a body of its own, in one piece or several. Particles
/// on its joints with other stiffnesses belong to it; its faces there are tied.
struct MaterialPart {
  Body body;                       ///< particles, and the lattice
  Network network;                 ///< with bonds before calibration
  std::vector<Index> particle_of;  ///< particle of the whole body, per particle
  std::vector<Index> facet_of;     ///< facet of the whole body, per facet
};

/// Returns one part for each stiffness; empty where all materials have the same stiffness, or where
/// finite elements are tied to the body.
/// \param whole  the body's bonds before calibration
std::vector<MaterialPart> cut_parts(const Body& body, const NetworkInput& input,
                                    const Network& whole);

/// Calibrates the bonds of a part, sets their critical stretches and fills Network::calibration.
using PartCalibration = std::function<void(const Body&, Network&)>;

/// Calibrates the parts one by one and joins them (docs/theory/calibration.md, section 3). Bonds
/// along a joint get the stiffness and strength of both sides; bonds that cross a joint are
/// removed. Displacements that are linear in every part and in equilibrium across the joints are
/// then in equilibrium. Returns false, with the network unchanged, where there are no parts, or
/// where the particles of a part cannot be balanced.
bool calibrate_parts(const Body& body, const NetworkInput& input, const PartCalibration& calibrate,
                     Network& whole);

}  // namespace perilink
