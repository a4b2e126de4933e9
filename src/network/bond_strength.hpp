#pragma once

#include <array>
#include <span>
#include <vector>

#include "network/lattice_neighbourhoods.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Limits of calibrated bonds. Calibration changes single bond stiffnesses, not the strength of the
/// material. So all bonds of a pair of materials have the limit of its interior bonds. A straight
/// crack then releases G_F on average.

namespace perilink {

/// Returns the fracture energy of bonds between two materials [force/length]: the smaller one, or
/// infinity if one material is unbreakable.
double energy_between(const SolidMaterial& a, const SolidMaterial& b);

/// Returns the materials that determine when a bond breaks: Network::materials_of or, if it is
/// empty, the materials of its ends.
std::array<Index, 2> materials_of_bond(const Network& network, Index bond);

/// Fills Network::materials_of where breakable materials of different strength meet. A particle on
/// their joint gets the material that the bond enters, or the weaker one for a bond in the joint.
void set_materials_at_joints(const NetworkInput& input, Network& network);

/// Returns the present k_b / k of every bond, which is Network::bending_ratio before a calibration
/// [-]. The result is empty where no bond carries a moment.
std::vector<double> own_bending_ratios(const Network& network);

/// Appends the critical stretch of the newest element; elastic analyses have no critical stretches.
inline void add_critical_stretch(const NetworkInput& input, double stretch, Network& network) {
  if (!input.elastic) network.critical_stretch.push_back(stretch);
}

/// Factors on properties [-], per bond of the solid; empty: nothing varies.
struct BondFactors {
  std::vector<double> strength;
  std::vector<double> energy;
  std::vector<double> modulus;
};

/// Returns the factors of some fields on a property in the middle of each bond of the solid.
/// Between two materials the smaller value of a property applies, as without fields.
std::vector<double> factors_on(VaryingProperty property, const NetworkInput& input,
                               std::span<const PropertyField> of_fields, const Network& network);

/// Returns the factors of NetworkInput::fields on all properties.
BondFactors property_factors(const NetworkInput& input, const Network& network);

/// Sets critical stretches from the neighbourhoods of a lattice, as the mean over all directions of
/// a crack.
/// \param cell_volume  volume of an interior particle [length^3]
void set_critical_stretches(const NetworkInput& input, const LatticeNeighbourhoods& neighbourhoods,
                            double cell_volume, Network& network);

/// Sets the critical stretches of an unstructured particle set from calibrated bonds of particles
/// not bonded to a facet. G_F is s_c^2 / 2 times the mean of |cos| times sum k xi^3 / (2 V).
/// Network::bending_ratio is multiplied by the mean of k_b / (ratio k) of these bonds, weighted
/// with xi^3. So bonds that break in shear release as much energy as bonds that break in extension.
/// Pairs of materials without such particles keep their values.
void set_strength_of_unstructured(const NetworkInput& input, Network& network);

}  // namespace perilink
