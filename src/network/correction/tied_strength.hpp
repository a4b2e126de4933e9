#pragma once

#include <cstddef>

#include "network/correction/joint.hpp"
#include "network/network.hpp"

namespace perilink {

/// Raises critical stretches of the bonds near the glued faces of a layer, which miss those across,
/// until no plane cut along a face takes less energy than inside the layer, within about a percent
/// (docs/theory/calibration.md, section 6). Nothing is done where the layer has no inside.
/// \param layer    number of the layer in the joint
/// \param network  the bonds of the layer alone, calibrated
/// \param horizon, spacing  [length]
void toughen_tied_faces(const Joint& joint, std::size_t layer, double horizon, double spacing,
                        Network& network);

}  // namespace perilink
