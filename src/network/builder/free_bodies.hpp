#pragma once

#include <cstdint>
#include <vector>

#include "network/loaded_network.hpp"
#include "network/rigid_modes.hpp"

namespace perilink {

/// Components that are prescribed, shape (particles, width); none of anchors, which move with their
/// particles.
std::vector<std::uint8_t> held_components(const Network& network, const Unknowns& unknowns);

/// Rigid-body motions of all fragments that neither prescribed components nor elastic supports
/// resist, each of shape (particles, width).
std::vector<std::vector<double>> free_motions(const Network& network, const Unknowns& unknowns);

/// How far the prescribed displacements of a fragment are from a rigid-body motion of it: the
/// largest difference, zero where they do not strain it [length].
/// \param held  shape (particles, width): where `prescribed` counts
double strained_motion(const Network& network, const Fragment& fragment,
                       const std::vector<std::uint8_t>& held,
                       const std::vector<double>& prescribed);

/// Takes the net force and the net couple out of the loads on a free fragment, by forces in
/// proportion to the masses (inertia relief): it then keeps its momentum and spin.
/// \param mass  shape (particles, width) [mass, mass length^2]
void balance_loads(const Network& network, const Fragment& fragment, std::vector<double> mass,
                   Loads& loads);

}  // namespace perilink
