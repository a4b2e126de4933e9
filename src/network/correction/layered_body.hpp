#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "network/correction/joint.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// A layer of a joint as a separate body: everything between two planes, with the particles in the
/// planes. Its faces in the planes are tied.
struct LayerBody {
  Body body;                       ///< particles, of one material, and the lattice
  Network network;                 ///< with bonds before calibration
  std::vector<Index> particle_of;  ///< particle of the whole body, per particle
  std::vector<Index> facet_of;     ///< facet of the whole body, per facet
};

/// \param whole  the body's bonds before calibration
LayerBody cut_layer(const Body& body, const NetworkInput& input, const Network& whole,
                    const Joint& joint, std::size_t layer);

/// Calibrates the bonds of one layer, by its number, sets their critical stretches and fills
/// Network::calibration.
using LayerCalibration = std::function<void(std::size_t, const Body&, Network&)>;

/// Calibrates the layers one by one and joins them (docs/theory/calibration.md, section 3). Bonds
/// in a plane get the stiffness and strength of both sides; bonds that cross a plane are removed.
/// Displacements that are linear in every layer and in equilibrium across the planes are then in
/// equilibrium. Returns false, with the network unchanged, where the particles of a layer cannot be
/// balanced.
bool calibrate_layers(const Body& body, const NetworkInput& input, const Joint& joint,
                      const LayerCalibration& calibrate, Network& whole);

}  // namespace perilink
