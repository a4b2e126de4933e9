#pragma once

#include <vector>

#include "hinge.hpp"

namespace perilink::verification {

/// Bonds of the infinite body in plane stress, softening along a bilinear curve.
struct SkinBonds {
  double poissons_ratio;  ///< 1/3: bonds do not bend
  double knee_stress_ratio, knee_opening_ratio;
  double horizon;  ///< over E G_F / f_t^2
};

/// Stress of a body of such bonds under growing uniform strain, up to f_t.
struct Skin {
  double strength_factor;  ///< beta
  std::vector<SkinPoint> curve;
};

Skin skin_of(const SkinBonds& bonds);

/// Energy per volume that such a body has dissipated when it comes to f_t, over f_t^2 / E.
double softened_before(const Skin& skin);

}  // namespace perilink::verification
