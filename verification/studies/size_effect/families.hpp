#pragma once

#include <vector>

#include "half_space.hpp"
#include "network/builder/network_builder.hpp"

/// \file
/// What the program's own bonds give to particles near a plane surface. Horizon and Young's modulus
/// are 1.

namespace perilink::verification {

/// Which particles are looked at.
struct NeighbourhoodInput {
  Problem problem = Problem::three_dimensional;  ///< square lattice in plane stress, else cubic
  int horizon_ratio = 3;                         ///< horizon / spacing
  std::vector<int> rows;                         ///< depths [spacings]
  std::vector<double> poissons_ratios;
};

/// Particles of the half-space x > 0, those of the program's conforming lattice with a row on the
/// surface; two horizons and three spacings deep, one horizon and one spacing to either side of
/// y = z = 0.
Body half_space_body(Problem problem, int horizon_ratio);

/// Constants of its bonds: micropolar, those of the lattice.
NetworkInput half_space_constants(Problem problem, double poissons_ratio);

/// Motion of particles in a homogeneous strain without rotation, shape (particles, width).
/// \param strain  normal strains along the axes
std::vector<double> homogeneous_motion(const Network& network, const Vector3& strain);

/// Stiffness in which the particles of the column y = z = 0 store the energy that they own, half of
/// that of their bonds; by row and Poisson's ratio. Only bonds of these particles are made, so that
/// horizons of dozens of spacings are possible.
std::vector<std::vector<LayerStiffness>> neighbourhood_stiffness(const NeighbourhoodInput& input);

/// Mean over a plate between two surfaces, of the particles' own stiffness: what each surface takes
/// away adds up, since no bond is cut by both. A uniform strain along the plate stores this energy,
/// so that no plate of these bonds can be stiffer.
/// \param rows  width of the plate [spacings]
LayerStiffness plate_of_neighbourhoods(Problem problem, int horizon_ratio, int rows,
                                       double poissons_ratio);

}  // namespace perilink::verification
