#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file
/// The constant c of a bond, pairwise force f = c s [force/length^6], from Young's modulus. A bond
/// between two particles is a truss of stiffness k = c V_i V_j / xi [force/length].

namespace perilink {

/// Where a constant of the bonds comes from.
enum class Constants {
  lattice,    ///< sums over the neighbours that a particle of the lattice really has
  continuum,  ///< integrals over the infinite body
};

/// Micromodulus of the infinite body, thickness t [length], horizon delta [length]:
/// plane stress c t = 9 E / (pi delta^3), plane strain c t = 48 E / (5 pi delta^3),
/// three dimensions c = 12 E / (pi delta^4) (Gerstle, Sau & Silling 2005, Eq. 6 with the thickness
/// that its text leaves out).
double continuum_micromodulus(Problem problem, double youngs_modulus, double horizon,
                              double thickness);

/// What the sums over a lattice give.
struct LatticeModuli {
  double micromodulus_per_modulus;  ///< c / E [1/length^4]
  double poissons_ratio;            ///< that of the lattice, not exactly bond_poissons_ratio()
};

/// Micromodulus that gives a particle inside the lattice the strain energy of the continuum, with
/// Young's modulus prescribed and Poisson's ratio free (Peri2D; Gerstle, Sau & Silling 2005,
/// section 3). In plane stress c V^2 = (E V / 2) (1/U1 + 1/U2), where U1 and U2 are the energies of
/// one particle at unit biaxial stretch and at unit pure shear, per unit of c V^2:
/// U1 = 1/4 sum xi, U2 = 1/4 sum xi cos^2(2 theta). In plane strain U1 / U2 = 1 / (1 - 2 nu) and
/// c V^2 = E V / (U2 (1 + nu)). In three dimensions the shear modulus is the lattice's Voigt mean,
/// which makes nu = 1/4 and c V^2 = 3 E V / U1, U1 the energy at unit hydrostatic stretch.
/// \param offsets      vectors to all neighbours [length]
/// \param cell_volume  V [length^3]
/// \throws std::invalid_argument where the neighbours cannot resist every strain
LatticeModuli lattice_moduli(Problem problem, std::span<const Vector3> offsets, double cell_volume);

}  // namespace perilink
