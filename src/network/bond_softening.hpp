#pragma once

#include <array>
#include <optional>
#include <stdexcept>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Bonds that soften (docs/theory/softening.md): the stretch s_0 where a bond's force begins to
/// fall follows from the tensile strength, the stretch where it has fallen to zero from the
/// fracture energy.

namespace perilink {

/// A bond dissipates at most so many times the energy that it holds at its strength [-]: beyond,
/// round-off decides where its secants leave the curve.
constexpr double most_softening = 1e10;

/// At the strength of a material a bond holds more energy than the fracture energy pays for, or
/// less than a part 1 / most_softening of it.
class TooStrong : public std::invalid_argument {
 public:
  TooStrong(Index material, double share);
  Index material;  ///< number in NetworkInput::materials
  double share;    ///< energy that the bond may dissipate over that which it holds
};

/// Law and strength of the bonds of one material.
struct MaterialBonds {
  BondLaw law;
  MaterialStrength strength;
};

/// Bonds that would break at the stretch s_c if they were brittle may dissipate s_c^2 / 2 per
/// stiffness and length; those that soften have 2 G_s / s_0^2 = (s_c / s_0)^2 and begin to at
/// s_0 = f_t / (beta E), with beta by cell_strength(). It depends on that energy: a fixed point.
/// \throws TooStrong where s_c does not exceed s_0, or (s_c / s_0)^2 most_softening
MaterialBonds bonds_of_material(const Body& body, const NetworkInput& input,
                                const SolidMaterial& material, double brittle_stretch);

/// A face whose bonds soften while those on either side of it do not.
struct FaceShape {
  std::optional<Vector3> normal;  ///< unit vector; nothing: the face is not plane
  /// Moduli behind it and where the normal points, over that of the bonds that cross it [-].
  std::array<double, 2> sides{1, 1};
  /// What its bonds bear at their limit, over what they would with the k_b by which they break [-].
  double held = 1.0;
};

/// The same of bonds that cross a face; beta is that of face_strength().
/// \param material  their mean constants with the law of the face; no concrete
/// \throws TooStrong
MaterialBonds bonds_of_face(const Body& body, const NetworkInput& input, const FaceShape& face,
                            const SolidMaterial& material, double brittle_stretch);

/// Gives bonds and ties between materials that soften their laws, in place of the brittle one and
/// its critical stretch, and the network its strengths (a draft also those of brittle ones). Two
/// materials have a law of their mean constants, with the shape of the weaker one; with a brittle
/// material bonds stay brittle.
/// \throws TooStrong
void soften_bonds(const Body& body, const NetworkInput& input, Network& network);

}  // namespace perilink
