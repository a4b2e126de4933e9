#pragma once

#include <array>
#include <vector>

#include "material/bond_law.hpp"

namespace perilink {

/// Force over deformation of bars and of their bond to the solid, the same in both directions: a
/// straight line from zero to the first point, then straight pieces from point to point.
struct ForceCurve {
  /// Deformation and force [any units]. Deformations rise; no later secant is above an earlier one.
  std::vector<std::array<double, 2>> points;
  bool endless = true;  ///< behind the last point its force stays; false: it falls to zero there

  double initial_stiffness() const { return points.front()[1] / points.front()[0]; }
  double force(double deformation) const;
  /// Area below the curve.
  double area(double deformation) const;
};

/// The curve of an element that has flowed, from the place to which it then unloads: elastic up to
/// the point where the flow came from, with the rest of the curve behind.
/// \param curve  over the deformation and force of its first point
/// \param flow   sum of the sizes of plastic deformations, of the same unit
ForceCurve curve_behind(const ForceCurve& curve, double flow);

/// \throws std::invalid_argument for a curve without points, deformations that do not rise from
///         above zero, negative forces, a first force of zero, or secants that rise
void check_curve(const ForceCurve& curve);

/// The curve as falling secants, whose deformations are over that of its first point. Between the
/// deformations at which two neighbouring secants leave the curve a tooth dissipates exactly what
/// the curve does (docs/theory/softening.md).
/// \param ratio  between secants, above one: the force moves by about (ratio - 1) / 2 about
///               a plateau
/// \throws std::invalid_argument as check_curve(), or for another ratio
BondLaw law_of(const ForceCurve& curve, double ratio);

}  // namespace perilink
