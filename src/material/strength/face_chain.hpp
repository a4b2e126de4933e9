#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "material/bond_law.hpp"

/// \file
/// A plane face inside a body whose bonds soften while those on either side stay whole: what they
/// make of the strength of the face (docs/theory/softening.md).

namespace perilink {

/// Bonds of a lattice particle that lead from its layer to the one `layers` above it, layers being
/// parallel to the face.
struct LayerBond {
  int layers = 1;
  double cosine = 1.0;       ///< between the bond and the normal of the face
  double weight = 0.0;       ///< k xi^2 over the volume of a particle [force/length^2]
  double shear_ratio = 0.0;  ///< k_b / k by which its shear counts in its equivalent stretch [-]
};

/// Those that are alike taken together. Nothing where the lattice has no such layers, or too many.
/// \param offsets      vectors to all neighbours [length]
/// \param axial        k of the bond to each [force/length]
/// \param shear_ratio  k_b / k of each; empty: bonds only stretch
/// \param cell_volume  volume of a particle [length^3]
std::optional<std::vector<LayerBond>> layer_bonds(std::span<const Vector3> offsets,
                                                  std::span<const double> axial,
                                                  std::span<const double> shear_ratio,
                                                  double cell_volume, const Vector3& normal);

/// Largest stress across the face of a body that is pulled along its normal and free to contract
/// along it, per unit of the critical stretch [force/length^2]. Layers move along the normal, those
/// far from the face by a uniform strain; bonds that cross the face pass the teeth of the law one
/// after another as in a damage analysis.
/// \param sides  stiffness of the bonds below and above over that of those that cross [-]
/// \param law    with teeth in tension alone
double face_strength(std::span<const LayerBond> bonds, std::array<double, 2> sides,
                     const BondLaw& law);

}  // namespace perilink
