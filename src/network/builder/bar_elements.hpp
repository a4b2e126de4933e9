#pragma once

#include <functional>

#include "discretization/rebar.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Constants of a slip spring to particles of one material.
struct SlipSpringConstants {
  double micromodulus = 0.0;  ///< c [force/length^6]
  double critical_stretch = 0.0;
};

/// Adds the bars of a body to the network of its solid: slip springs and bar elements.
/// \param mesh          its bars, whose particles the network already has
/// \param constants_of  constants of the bonds of a material
/// \throws std::invalid_argument if the solid cannot hold an embedded bar
void add_bars(const Body& body, const NetworkInput& input, RebarMesh mesh,
              const std::function<SlipSpringConstants(Index)>& constants_of, Network& network);

}  // namespace perilink
