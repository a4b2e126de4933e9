#pragma once

#include <vector>

namespace perilink::verification {

/// A fibre before its crack opens: stress over f_t, strain over f_t / E.
struct SkinPoint {
  double strain, stress;
};

/// Bending strength of a beam without a crack over the tensile strength by a cohesive hinge
/// (Ulfkjaer, Krenk & Brincker 1995, J. Eng. Mech. 121(1), 7-15): across half a depth either side
/// of which the beam stays plane, each fibre of this length strains elastically up to f_t and then
/// opens a crack along a bilinear curve.
/// \param knee_stress_ratio    stress at the knee over f_t; a straight line where both sum to one
/// \param knee_opening_ratio   opening there over the last one
/// \param depth                depth of the beam over E G_F / f_t^2
/// \param skin                 what each fibre does in place of straining elastically, from zero to
///                             a stress of one; then it unloads along its secant
double hinge_strength(double knee_stress_ratio, double knee_opening_ratio, double depth,
                      const std::vector<SkinPoint>& skin = {{0.0, 0.0}, {1.0, 1.0}});

}  // namespace perilink::verification
