#pragma once

#include <cstddef>

#include "network/correction/joint.hpp"
#include "network/network.hpp"

namespace perilink {

/// Raises critical stretches of bonds near the tied faces of a layer, to make up for the missing
/// bonds across the face. Every plane cut along a face then takes the energy of a cut inside the
/// layer, within about a percent (docs/theory/calibration.md, section 6). A layer without interior
/// stays unchanged.
/// \param layer    number of the layer in the joint
/// \param network  the calibrated bonds of the layer
/// \param horizon, spacing  [length]
void toughen_tied_faces(const Joint& joint, std::size_t layer, double horizon, double spacing,
                        Network& network);

}  // namespace perilink
