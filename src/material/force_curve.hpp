#pragma once

#include <array>
#include <vector>

#include "material/bond_law.hpp"

namespace perilink {

/// Force over deformation of bars or of their bond to the solid, equal in both directions. The
/// curve is straight from zero to the first point and between points.
struct ForceCurve {
  /// Deformation and force [any units]. Deformations rise, and secants do not.
  std::vector<std::array<double, 2>> points;
  bool endless = true;  ///< the force stays constant after the last point; false: it falls to zero
                        ///< there

  double initial_stiffness() const { return points.front()[1] / points.front()[0]; }
  double force(double deformation) const;
  /// Returns the area below the curve up to a deformation.
  double area(double deformation) const;
};

/// Returns the curve of an element after plastic flow, from its unloaded state. It is elastic up to
/// the point of unloading, then follows the rest of the curve.
/// \param curve  relative to the deformation and force of its first point
/// \param flow   sum of the magnitudes of plastic deformations, relative to the same deformation
ForceCurve curve_behind(const ForceCurve& curve, double flow);

/// Checks a curve.
/// \throws std::invalid_argument for a curve without points, deformations that do not rise above
///     zero, negative forces, a first force of zero, or rising secants
void check_curve(const ForceCurve& curve);

/// Returns the curve as saw-tooth segments, with stretches relative to the deformation of its first
/// point. Two successive secants meet the curve at two points. A segment dissipates the energy that
/// the curve dissipates between these points, with unloading along secants.
/// \param ratio  ratio of successive secants, above one; the overshoot on a plateau is about
///               (ratio - 1) / 2
/// \throws std::invalid_argument if check_curve() does, or for a ratio of one or less
BondLaw law_of(const ForceCurve& curve, double ratio);

}  // namespace perilink
