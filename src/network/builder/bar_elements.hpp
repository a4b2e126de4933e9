#pragma once

#include <functional>

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// What a bond between particles of one material is made from.
struct SlipSpringConstants {
  double micromodulus = 0.0;  ///< c [force/length^6]
  double critical_stretch = 0.0;
};

/// Adds the bars of a body to the network of its solid: particles, ties and segments.
/// \param constants_of  those of the bonds of a material
/// \throws std::invalid_argument where nothing can hold an anchored bar
void add_bars(const Body& body, const NetworkInput& input,
              const std::function<SlipSpringConstants(Index)>& constants_of, Network& network);

}  // namespace perilink
