#pragma once

#include <array>
#include <optional>
#include <stdexcept>

#include "discretization/lattices/lattice.hpp"
#include "network/network.hpp"
#include "network/network_input.hpp"

/// \file
/// Softening bonds (docs/theory/softening.md). The stretch s_0 at peak force follows from the
/// tensile strength. The stretch at zero force follows from the fracture energy.

namespace perilink {

/// Largest ratio of the dissipated energy of a bond to its energy at peak force [-]. Beyond it
/// round-off determines where the secants leave the curve.
constexpr double most_softening = 1e10;

/// Returns the number of events until a bond with this law has broken; the law must have an end.
Index count_segments(const BondLaw& law);

/// Returns the energy that tension events dissipate in a bond until it reaches a secant stiffness
/// ratio [-]. The reference is half of the stiffness times the squared extension at the critical
/// stretch.
double energy_until(const BondLaw& law, double secant);

/// Returns the energy that a bond dissipates until it has a secant stiffness ratio [force length].
double dissipated_until(const Network& network, Index bond, double secant);

/// Error for a tensile strength that does not fit the fracture energy. At that strength a bond
/// holds more energy than it may dissipate, or less than 1 / most_softening of it.
class TooStrong : public std::invalid_argument {
 public:
  TooStrong(Index material, double share, double scatter = 1.0, const Vector3& place = {});
  Index material;  ///< number in NetworkInput::materials, then interfaces
  double share;    ///< energy that the bond may dissipate over the energy that it holds [-]
  double scatter;  ///< factor of NetworkInput::fields on this share [-]
  Vector3 place;   ///< where the factor is so [length]; not without a factor
};

/// Law and strength of the bonds of one material.
struct MaterialBonds {
  BondLaw law;
  MaterialStrength strength;
};

/// Returns the law and the strength of a material's bonds. Brittle bonds with the critical stretch
/// s_c dissipate s_c^2 / 2 per stiffness and length. Softening bonds have
///   2 G_s / s_0^2 = (s_c / s_0)^2
/// and soften from s_0 = f_t / (beta E), with beta from cell_strength(). A fixed-point iteration
/// finds beta, which depends on that energy.
/// \throws TooStrong unless s_0 < s_c and (s_c / s_0)^2 < most_softening
MaterialBonds bonds_of_material(const Body& body, const NetworkInput& input,
                                const SolidMaterial& material, double brittle_stretch);

/// A face with softening bonds between two sides that do not soften.
struct FaceShape {
  std::optional<Vector3> normal;  ///< unit vector; empty: the face is not plane
  /// Moduli behind the face and ahead of it (along the normal), over the modulus of its bonds [-].
  std::array<double, 2> sides{1, 1};
  /// Force of its bonds at their limit over the force with the k_b of the breaking criterion [-].
  double held = 1.0;
};

/// Returns the law and the strength of bonds across a face, with beta from face_strength().
/// \param material  mean constants of the bonds with the law of the face; not concrete
/// \throws TooStrong
MaterialBonds bonds_of_face(const Body& body, const NetworkInput& input, const FaceShape& face,
                            const SolidMaterial& material, double brittle_stretch);

}  // namespace perilink
