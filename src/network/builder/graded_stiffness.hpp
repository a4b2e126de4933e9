#pragma once

#include <span>

#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Stiffness where Young's modulus varies in space (docs/theory/softening.md, section 12).

namespace perilink {

/// Multiplies the stiffness of calibrated bonds by the factor on Young's modulus in their middle. A
/// uniform strain then gives every interior particle the body force div(stress) of a linear factor
/// exactly. All elements of the network are bonds.
void scale_stiffness(const NetworkInput& input, Network& network);

/// Multiplies Lame's constants of cells by the factor on Young's modulus at their centroid, its
/// mean where it is linear.
/// \param positions  of the vertices, shape (particles, dim) [length]
void scale_stiffness(std::span<const PropertyField> fields, std::span<const double> positions,
                     LinearElements& elements);

}  // namespace perilink
