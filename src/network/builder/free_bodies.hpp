#pragma once

#include <cstdint>
#include <vector>

#include "network/loaded_network.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {

/// Flags prescribed components, shape (particles, width). Embedded points are not flagged, since
/// they follow their particles.
std::vector<std::uint8_t> held_components(const Network& network, const Unknowns& unknowns);

/// Returns the rigid-body motions of all fragments that neither prescribed components nor elastic
/// supports resist, each of shape (particles, width).
std::vector<std::vector<double>> free_motions(const Network& network, const Unknowns& unknowns);

/// Returns the largest difference between the prescribed displacements of a fragment and a
/// rigid-body motion [length]. Zero means that they do not strain it.
/// \param held  shape (particles, width): nonzero where `prescribed` applies
double strained_motion(const Network& network, const Fragment& fragment,
                       const std::vector<std::uint8_t>& held,
                       const std::vector<double>& prescribed);

/// Removes the net force and couple from the loads on a free fragment by forces proportional to its
/// masses (inertia relief). Momentum and spin of the fragment then stay constant.
/// \param mass  shape (particles, width) [mass, mass length^2]
void balance_loads(const Network& network, const Fragment& fragment, std::vector<double> mass,
                   Loads& loads);

}  // namespace perilink
