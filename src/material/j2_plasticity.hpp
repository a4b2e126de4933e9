#pragma once

#include <array>

#include "material/elasticity.hpp"

namespace perilink {

/// Yield stress over the equivalent plastic strain: linear hardening from `yield` to `ultimate`,
/// then linear softening to zero.
struct YieldCurve {
  double yield = 0.0;            ///< f_y [force/length^2]
  double ultimate = 0.0;         ///< f_u >= f_y [force/length^2]
  double ultimate_strain = 0.0;  ///< plastic strain at `ultimate` [-]
  double failure_strain = 0.0;   ///< plastic strain at which nothing is left [-]
};

/// [force/length^2]
double yield_stress(const YieldCurve& curve, double plastic_strain);

/// Plastic strain at which softening has dissipated the given energy per area in a band: the area
/// under the softening branch times the width of the band is the energy [-].
double failure_strain(const YieldCurve& curve, double fracture_energy, double width);

/// Symmetric tensor: xx, yy, zz, xy, yz, zx (components, not angles).
using SymmetricTensor = std::array<double, 6>;

/// Largest difference of principal stresses in von Mises' sense, sqrt(3 J2).
double mises_stress(const SymmetricTensor& stress);

/// What a particle has gone through.
struct PlasticState {
  SymmetricTensor strain{};        ///< plastic part; its trace is zero
  double equivalent_strain = 0.0;  ///< sum of sqrt(2/3 de : de)
};

/// Associated flow of von Mises from a total strain: backward Euler, so that the stress ends on the
/// yield surface (radial return in space and plane strain, the projected return of Simo & Taylor
/// 1986 in plane stress).
/// \param strain  total; in plane stress its out-of-plane components are not looked at
/// \param state   changed where the particle yields
/// \returns stress [force/length^2]
SymmetricTensor return_stress(Problem problem, double youngs_modulus, double poissons_ratio,
                              const YieldCurve& curve, const SymmetricTensor& strain,
                              PlasticState& state);

}  // namespace perilink
