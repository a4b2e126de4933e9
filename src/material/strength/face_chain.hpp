#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "material/bond_law.hpp"

/// \file
/// Strength of a plane face inside a body, from the law of its bonds (docs/theory/softening.md).
/// The bonds of the face soften between intact sides.

namespace perilink {

/// Bonds of a lattice particle from its layer to the one `layers` above it. Layers are parallel to
/// the face.
struct LayerBond {
  int layers = 1;
  double cosine = 1.0;       ///< between the bond and the normal of the face
  double weight = 0.0;       ///< k xi^2 over the volume of a particle [force/length^2]
  double shear_ratio = 0.0;  ///< k_b / k, the weight of shear in the equivalent stretch [-]
};

/// Returns the bonds with equivalent ones merged, or empty if the lattice has no such layers or too
/// many.
/// \param offsets      vectors to all neighbours [length]
/// \param axial        k of the bond to each [force/length]
/// \param shear_ratio  k_b / k of each; empty: trusses
/// \param cell_volume  volume of a particle [length^3]
std::optional<std::vector<LayerBond>> layer_bonds(std::span<const Vector3> offsets,
                                                  std::span<const double> axial,
                                                  std::span<const double> shear_ratio,
                                                  double cell_volume, const Vector3& normal);

/// Returns the largest stress across a face, per unit of the critical stretch [force/length^2]. The
/// body is in tension along the normal and free to contract laterally. Layers move along the
/// normal; far from the face they have a uniform strain. Bonds across the face have their events
/// one after another, as in a damage analysis.
/// \param sides  stiffness of the bonds below and above over the stiffness of the crossing bonds
///               [-]
/// \param law    without a compressive branch
double face_strength(std::span<const LayerBond> bonds, std::array<double, 2> sides,
                     const BondLaw& law);

}  // namespace perilink
