#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file Constants of micropolar bonds (Gerstle, Sau & Aguilera 2007). A bond between two particles
///     is a frame element. Its axial stiffness is k = c V_i V_j / xi [force/length], its bending
///     stiffness 12 d V_i V_j / xi^3 [force/length]. The two constants c and d give E and nu. Since
///     d must not be negative, bonds without bending have the largest nu.

namespace perilink {

/// Constants of a micropolar bond.
struct MicropolarModuli {
  double micromodulus = 0.0;     ///< c [force/length^6]
  double bending_modulus = 0.0;  ///< d [force/length^4]
};

/// Elastic constants of an isotropic solid.
struct ElasticConstants {
  double youngs_modulus = 0.0;  ///< E [force/length^2]
  double poissons_ratio = 0.0;  ///< nu [-]
};

/// Returns the constants of an infinite body with thickness t [length] and horizon delta [length]
/// (Gerstle, Sau & Aguilera 2007, Eqs. 15, 17 and 20):
///   plane stress      c t = 6 E / (pi delta^3 (1 - nu)),
///                     d t = E (1 - 3 nu) / (6 pi delta (1 - nu^2));
///   plane strain      c t = 6 E / (pi delta^3 (1 + nu) (1 - 2 nu)),
///                     d t = E (1 - 4 nu) / (6 pi delta (1 + nu) (1 - 2 nu));
///   three dimensions  c = 6 E / (pi delta^4 (1 - 2 nu)),
///                     d = E (1 - 4 nu) / (4 pi delta^2 (1 + nu) (1 - 2 nu)).
/// \throws std::invalid_argument for a Poisson's ratio of -1 or less, or above the ratio of bonds
///     without bending, where d would be negative
MicropolarModuli continuum_micropolar(Problem problem, const ElasticConstants& elastic,
                                      double horizon, double thickness);

/// Returns the constants for which an interior lattice particle has the energies of the continuum
/// in two strains. Unit biaxial (hydrostatic) stretch does not bend bonds and determines c. Unit
/// pure shear along the lattice's axes determines d; in three dimensions the Voigt mean of the
/// shear modulus does. The volume of a particle is V, and sums over its neighbours are
///   U1 = 1/4 sum xi, U2 = 1/4 sum xi cos^2(2 theta), U3 = 3 sum sin^2(2 theta) / xi;
///   plane stress      c V U1 = E / (1 - nu), c V U2 + d V U3 = E / (1 + nu);
///   plane strain      c V U1 = E / ((1 + nu) (1 - 2 nu)), c V U2 + d V U3 = E / (1 + nu);
///   three dimensions  2 c V U1 / 9 = K, 2 c V U1 / 15 + (3/5) d V sum 1/xi = G.
/// The largest Poisson's ratio is LatticeModuli::poissons_ratio, with d = 0 and c of
/// lattice_moduli().
/// \param offsets      vectors to all neighbours [length]
/// \param cell_volume  V [length^3]
/// \throws std::invalid_argument for a Poisson's ratio of -1 or less or above the lattice's own, or
///     if the neighbours cannot resist every strain
MicropolarModuli lattice_micropolar(Problem problem, std::span<const Vector3> offsets,
                                    double cell_volume, const ElasticConstants& elastic);

}  // namespace perilink
