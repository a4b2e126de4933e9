#pragma once

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Changes the stiffness of the solid bonds of a network, which the bulk's constants left too soft
/// near surfaces, as the body's surface option asks:
/// - energy: times the mean over both ends of (modulus of a particle inside the body / modulus that
///   its own bonds give it), modulus 1/2 sum k xi^2 per volume;
/// - calibrated: an isotropic family inside (make_isotropic) and, near surfaces and interfaces or
///   all over irregular clouds, calibrate_bonds(); materials in layers layer by layer
///   (calibrate_layers()). Bonds that end with nothing to carry are taken out. The critical
///   stretches follow the new stiffness, so that a straight crack releases G_F.
/// Nothing is done for other options. To be called before bars are added.
/// \throws std::invalid_argument where the horizon holds too few neighbours for an isotropic solid
void correct_surfaces(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
