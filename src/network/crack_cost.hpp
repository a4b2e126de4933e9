#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Returns the fracture-energy correction for lattice trapping [-]. It is the energy that a long
/// straight crack dissipates along the path of events, over the sum of the bonds across it (B-9).
/// The load must grow until the next bond at the crack tip breaks, and its excess energy is lost.
/// The loss is larger with fewer bonds at the tip. The table was measured in strips of each lattice
/// and of unstructured particle sets (verification/studies/toughness). It depends on the neighbours
/// within the horizon and on the ratio of Lame's constants, not on lengths or moduli. Cracks in
/// lattices run along x, between two rows.
double crack_cost(const Body& body, const NetworkInput& input, const SolidMaterial& material);

/// Smallest horizon over spacing for which the correction is independent of the crack path, within
/// a few percent.
inline constexpr double least_ratio_of_cracks = 3.0;

}  // namespace perilink
