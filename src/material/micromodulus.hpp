#pragma once

#include <span>

#include "base/types.hpp"
#include "material/elasticity.hpp"

/// \file
/// The constant c of a bond with the pairwise force f = c s [force/length^6], from Young's modulus.
/// A bond between two particles is a truss of stiffness k = c V_i V_j / xi [force/length].

namespace perilink {

/// Source of the constants of bonds.
enum class Constants {
  lattice,    ///< sums over the actual neighbours of a particle of the lattice
  continuum,  ///< integrals over the infinite body
};

/// Returns the micromodulus c of an infinite body with thickness t [length] and horizon delta
/// [length] (Gerstle, Sau & Silling 2005, Eq. 6 with the thickness that its text omits):
///   plane stress      c t = 9 E / (pi delta^3);
///   plane strain      c t = 48 E / (5 pi delta^3);
///   three dimensions  c = 12 E / (pi delta^4).
double continuum_micromodulus(Problem problem, double youngs_modulus, double horizon,
                              double thickness);

/// Moduli from sums over a lattice.
struct LatticeModuli {
  double micromodulus_per_modulus;  ///< c / E [1/length^4]
  double poissons_ratio;            ///< the lattice's own, not exactly bond_poissons_ratio()
};

/// Returns the micromodulus for which an interior lattice particle has the strain energy of the
/// continuum. Young's modulus is prescribed and Poisson's ratio free (Peri2D; Gerstle, Sau &
/// Silling 2005, section 3). U1 = 1/4 sum xi is the energy of one particle per c V^2 at unit
/// biaxial stretch, hydrostatic in three dimensions. U2 = 1/4 sum xi cos^2(2 theta) is its energy
/// at unit pure shear.
///   plane stress      c V^2 = (E V / 2) (1/U1 + 1/U2);
///   plane strain      U1 / U2 = 1 / (1 - 2 nu), c V^2 = E V / (U2 (1 + nu));
///   three dimensions  nu = 1/4, c V^2 = 3 E V / U1, by the Voigt mean of the shear modulus.
/// \param offsets      vectors to all neighbours [length]
/// \param cell_volume  V [length^3]
/// \throws std::invalid_argument if the neighbours cannot resist every strain
LatticeModuli lattice_moduli(Problem problem, std::span<const Vector3> offsets, double cell_volume);

}  // namespace perilink
