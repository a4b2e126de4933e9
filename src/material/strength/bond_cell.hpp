#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "material/bond_law.hpp"
#include "material/elasticity.hpp"

/// \file
/// Cell of the bonds of one interior particle under a uniform strain: relates the law of bonds to
/// the strength of the body.

namespace perilink {

/// A bond of the cell.
struct CellBond {
  Vector3 direction;         ///< unit vector
  double weight = 0.0;       ///< k xi^2 over the volume [force/length^2]
  double shear_ratio = 0.0;  ///< k_b / k, the weight of shear in the equivalent stretch [-]
};

/// Returns the bonds of a lattice particle, each pair of opposite neighbours once.
/// \param offsets      vectors to its neighbours [length]
/// \param axial        k of the bond to each [force/length]
/// \param shear_ratio  k_b / k of each; empty: trusses
/// \param cell_volume  volume of the particle [length^3]
std::vector<CellBond> lattice_cell(std::span<const Vector3> offsets, std::span<const double> axial,
                                   std::span<const double> shear_ratio, double cell_volume);

/// Returns bonds of all lengths and directions of an infinite body, in the plane or in space. Their
/// shares of the stiffness add up to one. The ratio k_b / k follows from Lame's constants in the
/// body's kinematics (docs/theory/softening.md). Its mean is (1 - r) / (1 + r) in the plane and 2
/// (1 - r) / (2 + 3 r) in space. It falls with the square of the length.
/// \param lame_ratio  r = lambda / mu, one for trusses
std::vector<CellBond> isotropic_cell(Problem problem, double lame_ratio);

/// Returns Young's modulus of the cell in a direction, without lateral stress [force/length^2].
double cell_modulus(std::span<const CellBond> cell, int dim, const Vector3& pull);

/// Returns the largest stress of the cell in uniaxial tension, over cell_modulus() times the
/// critical stretch [-]. The strain is uniform and particles do not rotate. Bonds have their events
/// one after another, as in a damage analysis.
/// \param law  without a compressive branch
double cell_strength(std::span<const CellBond> cell, int dim, const Vector3& pull,
                     const BondLaw& law);

/// Lateral condition of a loaded cell.
enum class Across {
  free,  ///< no stress
  held,  ///< no strain
};

/// Loading of a cell.
struct CellDrive {
  Vector3 direction;
  bool compressed = false;
  Across across = Across::free;
};

/// State of a cell before an event: strain [-] and stress [force/length^2] along the loading
/// direction, positive in compression too.
struct CellPoint {
  double strain, stress;
};

/// Returns every event of a cell until it fails or has no further event. Bonds with a compressive
/// branch have events by their axial stretch. The first event in tension makes all compressive
/// branches active, since all bonds have one particle in common.
/// \param critical_stretch  reference stretch of the law [-]
std::vector<CellPoint> cell_path(std::span<const CellBond> cell, int dim, const CellDrive& drive,
                                 const BondLaw& law, double critical_stretch);

/// Returns the stress at a strain under monotonic loading [force/length^2]. Between two events it
/// is on the line from the origin to the second one; after the last event it is NaN.
double stress_at(std::span<const CellPoint> path, double strain);

}  // namespace perilink
