#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "material/bond_law.hpp"
#include "material/elasticity.hpp"

/// \file
/// The bonds of one particle inside a body under a uniform strain: what bonds that soften make of
/// the strength of the body.

namespace perilink {

/// A bond of the cell.
struct CellBond {
  Vector3 direction;         ///< unit vector
  double weight = 0.0;       ///< k xi^2 over the volume [force/length^2]
  double shear_ratio = 0.0;  ///< k_b / k by which its shear counts in its equivalent stretch [-]
};

/// Bonds of a lattice particle, each pair of opposite neighbours once.
/// \param offsets      vectors to its neighbours [length]
/// \param axial        k of the bond to each [force/length]
/// \param shear_ratio  k_b / k of each; empty: bonds only stretch
/// \param cell_volume  volume of the particle [length^3]
std::vector<CellBond> lattice_cell(std::span<const Vector3> offsets, std::span<const double> axial,
                                   std::span<const double> shear_ratio, double cell_volume);

/// Bonds of all lengths and directions of the infinite body, in the plane or in space; of their
/// shares of the stiffness, which add up to one, those in shear follow from the ratio of Lame's
/// constants in the body's kinematics: that of k_b to k is (1 - r) / (1 + r) in the plane and
/// 2 (1 - r) / (2 + 3 r) in space in the mean, and falls with the square of the length
/// (docs/theory/softening.md).
/// \param lame_ratio  r = lambda / mu, one where bonds only stretch
std::vector<CellBond> isotropic_cell(Problem problem, double lame_ratio);

/// Young's modulus of the cell in a direction, stresses across it zero [force/length^2].
double cell_modulus(std::span<const CellBond> cell, int dim, const Vector3& pull);

/// Largest stress of the cell pulled in one direction, stresses across it zero, over cell_modulus()
/// times the critical stretch [-]. The strain is uniform, particles do not rotate,
/// and bonds pass the teeth of the law one after another as in a damage analysis.
/// \param law  with teeth in tension alone
double cell_strength(std::span<const CellBond> cell, int dim, const Vector3& pull,
                     const BondLaw& law);

/// What a cell does across the direction in which it is driven.
enum class Across {
  free,  ///< no stress
  held,  ///< no strain
};

/// How a cell is driven.
struct CellDrive {
  Vector3 direction;
  bool compressed = false;
  Across across = Across::free;
};

/// A cell before an event: strain and stress along the drive, both positive in compression too
/// [-, force/length^2].
struct CellPoint {
  double strain, stress;
};

/// Every event of a cell whose bonds have the law until it has failed or no more events come. Bonds
/// with teeth in compression of their own count by their axial stretch; all wake by the first event
/// in tension, as they have one particle in common.
/// \param critical_stretch  by which the law counts
std::vector<CellPoint> cell_path(std::span<const CellBond> cell, int dim, const CellDrive& drive,
                                 const BondLaw& law, double critical_stretch);

/// The stress at a strain to which the cell is driven without return: between two events it is on
/// the line from the origin to the second one. Not a number behind the last event.
double stress_at(std::span<const CellPoint> path, double strain);

}  // namespace perilink
