#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Corrects the stiffness of the solid bonds of a network, which is too small near surfaces, by the
/// body's surface option:
/// - energy: multiplies by the mean over both ends of (modulus of an interior particle / modulus of
///   the particle), modulus 1/2 sum k xi^2 per volume;
/// - calibrated: makes interior neighbourhoods isotropic (make_isotropic). Near surfaces and
///   interfaces, and everywhere in unstructured particle sets, uses calibrate_bonds(); parts of
///   unlike stiffness use calibrate_parts(). Removes bonds without stiffness. Sets critical
///   stretches by the new stiffness, so that a straight crack releases G_F.
/// Other options change nothing. To be called before bars are added.
/// \throws std::invalid_argument  where the horizon holds too few neighbours for an isotropic solid
void correct_surfaces(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
