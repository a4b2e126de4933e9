#pragma once

#include <array>
#include <vector>

#include "network/lattice_neighbourhoods.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// When calibrated bonds break. Calibration changes what single bonds carry, not what the material
/// bears: their limits are those of the bonds inside the body, the same for all of a pair of
/// materials, and such that a straight crack releases G_F in the mean.

namespace perilink {

/// Fracture energy of the bonds between two materials: the smaller one; beside an unbreakable
/// material bonds do not break [force/length].
double energy_between(const SolidMaterial& a, const SolidMaterial& b);

/// Materials that decide when a bond breaks: Network::materials_of or, where it is empty, those of
/// its ends.
std::array<Index, 2> materials_of_bond(const Network& network, Index bond);

/// Fills Network::materials_of where breakable materials of different strength meet: a particle on
/// their joint counts as the material that the bond enters there, in the joint as the weaker one.
void set_materials_at_joints(const NetworkInput& input, Network& network);

/// k_b / k of every bond as it is, the Network::bending_ratio before a calibration [-]; empty where
/// no bond carries a moment.
std::vector<double> own_bending_ratios(const Network& network);

/// Gives the newest element its critical stretch; elastic analyses ask for none.
inline void add_critical_stretch(const NetworkInput& input, double stretch, Network& network) {
  if (!input.elastic) network.critical_stretch.push_back(stretch);
}

/// Critical stretches from the families of a lattice, the mean over all directions of a crack.
/// \param cell_volume  volume of a particle inside [length^3]
void set_critical_stretches(const NetworkInput& input, const LatticeNeighbourhoods& neighbourhoods,
                            double cell_volume, Network& network);

/// Critical stretches of an irregular cloud, from the calibrated bonds of the particles that are
/// bonded to none on a facet: G_F = s_c^2 / 2 times the mean of |cos| times sum k xi^3 / (2 V).
/// Network::bending_ratio is multiplied by the mean of k_b / (ratio k) of these bonds, each with
/// its xi^3, so that bonds that break in shear release as much as those that break in extension.
/// Pairs of materials without such particles keep what they have.
void set_strength_of_unstructured(const NetworkInput& input, Network& network);

}  // namespace perilink
