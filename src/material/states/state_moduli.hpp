#pragma once

#include "material/elasticity.hpp"

namespace perilink {

/// Elastic constants of a state-based lattice particle. The force state of bond j is
///   F_j = (own + [j is far] far) S_j + sum * sum_m (L_m / L_0) S_m,
/// with the stretches S of all bonds of the particle, their lengths L and the spacing L_0. With
/// these constants (1 / 2V) sum_j L_j F_j n_j n_j' is exactly Hooke's stress of a uniform strain.
struct StateModuli {
  double own = 0.0;  ///< [force]
  double far = 0.0;  ///< added for bonds to second neighbours (face-centred cubic) [force]
  double sum = 0.0;  ///< [force]
};

/// Returns the constants for six bonds per particle (Nikravesh & Gerstle 2018, Eqs. 19 and 20).
/// \param problem    plane_stress or plane_strain
/// \param spacing    L_0 [length]
/// \param thickness  thickness of two-dimensional bodies [length]
/// \throws std::invalid_argument in three dimensions or for a ratio outside (-1, 1/2)
StateModuli hexagonal_moduli(Problem problem, double youngs_modulus, double poissons_ratio,
                             double spacing, double thickness);

/// Returns the constants for twelve bonds of length L_0 and six of sqrt(2) L_0 per particle. In the
/// dissertation of Nikravesh (2017, Eq. 4.8) the third term multiplies the sum of the far
/// stretches. Here it multiplies the far bond's own stretch, which the lattice needs to be
/// isotropic. Lengths weight the sum, so that the forces derive from an energy.
/// \throws std::invalid_argument for a ratio outside (-1, 1/2)
StateModuli face_centred_moduli(double youngs_modulus, double poissons_ratio, double spacing);

}  // namespace perilink
