#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file
/// Constants of micropolar bonds (Gerstle, Sau & Aguilera 2007): a bond between two particles is a
/// frame element with the axial stiffness k = c V_i V_j / xi [force/length] and the bending
/// stiffness 12 d V_i V_j / xi^3 [force/length]. Two constants give two elastic ones, E and nu, as
/// long as d is not negative: nu up to that of bonds without bending.

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

/// Constants of the infinite body, thickness t [length], horizon delta [length]:
/// plane stress c t = 6 E / (pi delta^3 (1 - nu)), d t = E (1 - 3 nu) / (6 pi delta (1 - nu^2));
/// plane strain c t = 6 E / (pi delta^3 (1 + nu) (1 - 2 nu)),
///              d t = E (1 - 4 nu) / (6 pi delta (1 + nu) (1 - 2 nu));
/// three dimensions c = 6 E / (pi delta^4 (1 - 2 nu)),
///                  d = E (1 - 4 nu) / (4 pi delta^2 (1 + nu) (1 - 2 nu))
/// (Gerstle, Sau & Aguilera 2007, Eqs. 15, 17 and 20).
/// \throws std::invalid_argument for a Poisson's ratio at or below -1 or above that of bonds
///         without bending (d would be negative: the bond would gain energy by bending)
MicropolarModuli continuum_micropolar(Problem problem, const ElasticConstants& elastic,
                                      double horizon, double thickness);

/// Constants that give a particle inside the lattice the energies of the continuum in two strains:
/// unit biaxial (hydrostatic) stretch, where bonds do not bend, settles c; unit pure shear along
/// the lattice's axes, in three dimensions the Voigt mean of the shear modulus, settles d. With
/// U1 = 1/4 sum xi, U2 = 1/4 sum xi cos^2(2 theta), U3 = 3 sum sin^2(2 theta) / xi over the
/// neighbours and the volume V of a particle:
/// plane stress c V U1 = E / (1 - nu), c V U2 + d V U3 = E / (1 + nu);
/// plane strain c V U1 = E / ((1 + nu) (1 - 2 nu)), the second line alike;
/// three dimensions 2 c V U1 / 9 = K, 2 c V U1 / 15 + (3/5) d V sum 1/xi = G.
/// Poisson's ratio may reach LatticeModuli::poissons_ratio, where d = 0 and c is that of
/// lattice_moduli().
/// \param offsets      vectors to all neighbours [length]
/// \param cell_volume  V [length^3]
/// \throws std::invalid_argument for a Poisson's ratio at or below -1 or above the lattice's own,
///         or where the neighbours cannot resist every strain
MicropolarModuli lattice_micropolar(Problem problem, std::span<const Vector3> offsets,
                                    double cell_volume, const ElasticConstants& elastic);

}  // namespace perilink
