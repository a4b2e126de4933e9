#pragma once

#include <array>

#include "material/elasticity.hpp"

namespace perilink {

/// Yield stress over equivalent plastic strain: linear hardening from `yield` to `ultimate`, then
/// linear softening to zero.
struct YieldCurve {
  double yield = 0.0;            ///< f_y [force/length^2]
  double ultimate = 0.0;         ///< f_u >= f_y [force/length^2]
  double ultimate_strain = 0.0;  ///< plastic strain at `ultimate` [-]
  double failure_strain = 0.0;   ///< plastic strain at zero yield stress [-]
};

/// Returns the yield stress at an equivalent plastic strain [force/length^2].
double yield_stress(const YieldCurve& curve, double plastic_strain);

/// Returns the plastic strain at the end of softening [-]: the area under the softening branch
/// times the width of the band is the fracture energy.
double failure_strain(const YieldCurve& curve, double fracture_energy, double width);

/// Symmetric tensor xx, yy, zz, xy, yz, zx, with tensor shear components.
using SymmetricTensor = std::array<double, 6>;

/// Returns the von Mises stress sqrt(3 J2) [force/length^2].
double mises_stress(const SymmetricTensor& stress);

/// Plastic history of a particle.
struct PlasticState {
  SymmetricTensor strain{};        ///< plastic strain; its trace is zero [-]
  double equivalent_strain = 0.0;  ///< sum of sqrt(2/3 de : de) [-]
};

/// Integrates the associated von Mises flow from a total strain by backward Euler, so that the
/// stress ends on the yield surface. Uses radial return in space and plane strain, and the
/// projected return of Simo & Taylor (1986) in plane stress.
/// \param strain  total; in plane stress its out-of-plane components are ignored
/// \param state   updated if the particle yields
/// \return stress [force/length^2]
SymmetricTensor return_stress(Problem problem, double youngs_modulus, double poissons_ratio,
                              const YieldCurve& curve, const SymmetricTensor& strain,
                              PlasticState& state);

}  // namespace perilink
