#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// What a long straight crack dissipates along the path of the events, over what the sum of the
/// bonds across it says (B-9) [-]. The body has to be loaded until the next bond at the crack's tip
/// gives way, which then snaps: more is lost than the bond held, and the more so the fewer bonds
/// share the work. Measured once, in strips of each lattice and of irregular clouds
/// (verification/studies/toughness); it depends on the neighbours within the horizon and on the
/// ratio of Lame's constants, on no length and no modulus. Cracks of lattices run along x, between
/// two rows.
double crack_cost(const Body& body, const NetworkInput& input, const SolidMaterial& material);

/// Horizon over spacing from which on the cost of a crack is the same, within a few percent,
/// whatever its path.
inline constexpr double least_ratio_of_cracks = 3.0;

}  // namespace perilink
