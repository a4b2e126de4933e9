#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Sets the laws and critical stretches of bonds and slip springs between softening materials, and
/// the network's strengths. An uncalibrated model also gets the strengths of brittle materials.
/// Bonds between two materials have their mean constants and the weaker one's curve. Bonds to a
/// brittle material stay brittle.
///
/// NetworkInput::fields scales the strength of each softening bond exactly. The shape of its law,
/// which keeps the fracture energy, is that of a class: the energy of a bond is within 1 %. The
/// critical stretch of a brittle bond follows from its energy and modulus alone. Slip springs and
/// laws by stretches do not vary.
/// \throws TooStrong
void soften_bonds(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
