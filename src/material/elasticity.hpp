#pragma once

namespace perilink {

/// Kinematics of the body.
enum class Problem {
  plane_stress,
  plane_strain,
  three_dimensional,
  shell,  ///< a mid-surface in space: plane stress and bending
  beam,   ///< a line in the plane: axial force and bending
};

/// Returns 2 or 3; 2 for the mid-surface of a shell and for beams.
int dimension_of(Problem problem);

/// Returns the only Poisson's ratio of a bond-based isotropic solid (Gerstle, Sau & Silling 2005,
/// section 2). It is 1/3 in plane stress and in shells, and 1/4 in plane strain and in three
/// dimensions.
double bond_poissons_ratio(Problem problem);

/// An isotropic elastic solid with Poisson's ratio between -1 and 1/2.
struct IsotropicMaterial {
  double youngs_modulus = 0.0;  ///< E [force/length^2]
  double poissons_ratio = 0.0;  ///< [-]
};

/// Lame's constants: stress = lambda trace(strain) + 2 mu strain, in the plane or in space
/// [force/length^2].
struct HookeConstants {
  double lambda = 0.0;  ///< in plane stress the value for the plane, E nu / (1 - nu^2)
  double mu = 0.0;      ///< shear modulus
};
HookeConstants hooke_constants(Problem problem, double youngs_modulus, double poissons_ratio);

}  // namespace perilink
