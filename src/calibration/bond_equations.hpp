#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"

/// \file Contributions of a bond, per unit of its stiffness, to the forces on its ends and to their
///     elastic moduli under every uniform strain. Symmetric tensors are stored by components with
///     ascending indices: third order xxx, xxy, xyy, yyy in two dimensions, ten components in
///     three; fourth order five and fifteen.

namespace perilink {

/// Elastic constants C = lambda dd + mu (dd + dd), d Kronecker's delta; in plane stress the
/// constants of the plane. Bonds without moments require lambda = mu.
struct LameConstants {
  double lambda = 0.0;  ///< [force/length^2]
  double mu = 0.0;      ///< [force/length^2]
  bool operator==(const LameConstants&) const = default;
};

/// Stiffness of the bonds, at the start or at the end of a calibration.
struct BondStiffness {
  std::vector<double> axial;    ///< [force/length]
  std::vector<double> bending;  ///< [force/length]; empty where bonds carry no moment
  /// Fraction of the couple of the transverse force that acts at the first end: position of the
  /// point of inflection over the length [-]; empty where bonds carry no moment.
  std::vector<double> inflection;
};

/// Equations of equilibrium under all uniform strains at a particle without rotation. An axial
/// stiffness k pulls with k xi (n.eps.n) n, a bending stiffness k with k xi (eps.n - (n.eps.n) n)
/// and, at each end, one half of the couple k xi^2 n x (eps.n). Forces and moments vanish for every
/// strain where
///   sum (k_axial - k_bending) xi nnn = -lambda (d_ab A_c + d_ac A_b + d_bc A_a),
///   sum k_bending xi n = -2 (mu - lambda) A,   sum k_bending xi^2 (nn - I/dim) = 0,
/// with the area vector A of the particle. Without bending only the first equation holds, with
/// lambda = mu. The first two act on both ends with opposite signs. Where the couple is not halved,
/// the last equation weights bending stiffnesses by twice the fraction of their couple at the
/// particle.
///
/// With `dilatation` the last row is the energy of a uniform dilatation, eps = identity. Half of
/// the energy of the bonds belongs to the particle,
///   1/2 sum k_axial xi^2 = V (dim^2 lambda + 2 dim mu).
struct ForceRows {
  int dim;
  bool bending;  ///< whether bonds carry moments
  bool dilatation = false;

  int third_order() const { return dim == 2 ? 4 : 10; }
  int odd() const { return third_order() + (bending ? dim : 0); }
  int balance() const { return odd() + (bending ? (dim == 2 ? 2 : 5) : 0); }  ///< forces, moments
  int count() const { return balance() + (dilatation ? 1 : 0); }

  void axial(double length, std::span<const double> direction, double* row) const;
  void shear(double length, std::span<const double> direction, double* row) const;
  void fill(double length, std::span<const double> direction, bool bending_part,
            double* row) const {
    bending_part ? shear(length, direction, row) : axial(length, direction, row);
  }
  /// Fills the right side of a particle from sum lambda A and sum mu A over its materials, in and
  /// out of the facets [force]. Zero in the row of the dilatation.
  void right(const Vector3& lambda_area, const Vector3& mu_area, double* row) const;
};

/// Equations of the moduli of a particle: half of the energy of its bonds equals the energy of its
/// volume under every uniform strain,
///   1/2 sum xi^2 (k_axial nnnn + k_bending ((d nn) - nnnn)) = V C,
/// ((d nn) the symmetrised product with eps.(d nn).eps = |eps.n|^2). Without bending both sides are
/// symmetric in all indices. With bending the couples must be in balance too, which is a separate
/// condition in stretched lattices: sum k_bending xi^2 (nn - I/dim) = 0.
struct ModuliRows {
  int dim;
  bool bending;

  int moduli() const { return bending ? (dim == 2 ? 6 : 21) : (dim == 2 ? 5 : 15); }
  int count() const { return moduli() + (bending ? (dim == 2 ? 2 : 5) : 0); }

  void axial(double length, std::span<const double> direction, double* row) const;
  void shear(double length, std::span<const double> direction, double* row) const;
  void right(double volume, const LameConstants& constants, double* row) const;
};

/// Returns the right side of the row of the dilatation for a particle of this volume [force
/// length].
inline double dilatation_modulus(int dim, double volume, const LameConstants& constants) {
  return volume * (dim * dim * constants.lambda + 2.0 * dim * constants.mu);
}

/// Computes the right sides of the force equations of all particles from the materials on the sides
/// of their facets. \return shape (particles, rows) [force]
std::vector<double> boundary_forces(const ForceRows& equations, const Facets& facets,
                                    std::span<const LameConstants> materials, Index num_particles);

/// Returns the constants inside a facet minus the constants outside; on the surface the constants
/// inside.
LameConstants constants_across(const Facets& facets, Index facet,
                               std::span<const LameConstants> materials);

/// Computes the unbalanced forces of bonds with these stiffnesses. \return shape (particles, rows)
/// [force]
std::vector<double> forces_out_of_balance(const ForceRows& equations, const Facets& facets,
                                          std::span<const LameConstants> materials,
                                          const Bonds& bonds, const BondStiffness& stiffness,
                                          Index num_particles);

}  // namespace perilink
