#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "network/correction/joint.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// A layer of a joint as a body of its own: what lies between two planes, the particles in them
/// included. Its faces there are glued.
struct LayerBody {
  Body body;                       ///< particles, of one material, and the lattice
  Network network;                 ///< with bonds as they are before they are calibrated
  std::vector<Index> particle_of;  ///< number of each particle in the whole body
  std::vector<Index> facet_of;     ///< and of each facet
};

/// \param whole  the body's bonds before they are calibrated
LayerBody cut_layer(const Body& body, const NetworkInput& input, const Network& whole,
                    const Joint& joint, std::size_t layer);

/// Calibrates the bonds of one layer, by its number, sets their critical stretches and fills
/// Network::calibration.
using LayerCalibration = std::function<void(std::size_t, const Body&, Network&)>;

/// Calibrates the layers one by one and puts them together: bonds in a plane are those of both
/// sides, and break when they hold what both may, bonds that cross one are taken out, and
/// displacements that are linear in every layer and in equilibrium across the planes are in
/// equilibrium (docs/theory/calibration.md, section 3). False, and the network as it was, where the
/// particles of a layer find no balance.
bool calibrate_layers(const Body& body, const NetworkInput& input, const Joint& joint,
                      const LayerCalibration& calibrate, Network& whole);

}  // namespace perilink
