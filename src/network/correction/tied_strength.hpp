#pragma once

#include "network/network.hpp"

namespace perilink {

/// Raises critical stretches of bonds near the tied faces of a part, to make up for the missing
/// bonds across them. Every cut at a constant distance from a face then takes the energy of a cut
/// inside the part, within about a percent (docs/theory/calibration.md, section 6). A part without
/// interior stays unchanged.
/// \param network  the calibrated bonds of the part
/// \param horizon, spacing  [length]
void toughen_tied_faces(double horizon, double spacing, Network& network);

}  // namespace perilink
