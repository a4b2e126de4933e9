#pragma once

#include "discretization/lattices/lattice.hpp"

namespace perilink::verification {

/// A long bar of micropolar bonds in plane stress, pulled at its ends. The horizon is 1.
struct BarInput {
  int width = 2;  ///< [horizons]
  int horizon_ratio = 6;
  double poissons_ratio = 0.2;
  Surface surface = Surface::none;  ///< none or calibrated
};

/// Apparent Young's modulus over that of the material: mean stress over the mean strain of a piece
/// in the middle, far from the loads.
double apparent_modulus(const BarInput& input);

}  // namespace perilink::verification
