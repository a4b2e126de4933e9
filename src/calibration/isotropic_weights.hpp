#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "calibration/bond_equations.hpp"

namespace perilink {

/// Stiffness of the bonds of a lattice particle, by the vector to its neighbour.
struct NeighbourhoodStiffness {
  std::vector<double> axial;    ///< [force/length]
  std::vector<double> bending;  ///< [force/length]; empty where bonds carry no moment
};

/// Makes an interior particle of a lattice exactly isotropic with the given constants, by the least
/// relative change of its bonds' stiffness, which stays positive: sum over the neighbours of 1/2
/// xi^2 (k_axial nnnn + ...) = V C (ModuliRows). Equivalent neighbours change equally.
/// \param offsets  vectors to all neighbours, in opposite pairs [length]
/// \param volume     V of a particle [length^3]
/// \param stiffness  start and result
/// \throws std::invalid_argument  where the neighbours are too few
void make_isotropic(int dim, std::span<const Vector3> offsets, double volume,
                    const LameConstants& constants, NeighbourhoodStiffness& stiffness);

/// Returns the part of a neighbour's cell within the horizon, which falls linearly over one
/// spacing: min(1, (delta + h/2 - xi) / h) (Hu, Ha & Bobaru 2010).
double partial_volume(double length, double horizon, double spacing);

}  // namespace perilink
