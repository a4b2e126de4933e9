#pragma once

#include <array>

#include "discretization/lattices/lattice.hpp"
#include "material/elasticity.hpp"

/// \file
/// A long strip of one lattice, torn along its middle: what a crack costs.

namespace perilink::verification {

/// The strip is clamped by layers one horizon thick above and below, which move apart, and cracked
/// from its left end. Its bonds are those inside a calibrated body; in space it repeats itself
/// along the crack's front.
struct Strip {
  Pattern pattern = Pattern::rectangular;
  double horizon_ratio = 3.0;
  double lame_ratio = 1.0;             ///< lambda / mu [-]; below one bonds are micropolar
  bool calibrated = true;              ///< false: one micromodulus, as with surface = "none"
  std::array<int, 2> growth = {2, 0};  ///< period along the crack, in half steps of the lattice
  double half_height = 3.0;            ///< between crack and clamps, in horizons
  double beside = 1.5;                 ///< length at either end, in half heights
  int skipped = 6;                     ///< periods that the crack grows before it counts
  int counted = 24;
  int front = 1;                               ///< periods along the front, in space
  std::array<double, 2> stretch = {1.0, 1.0};  ///< factors on the steps of the lattice
};

/// Energies per area of crack, over the sum of bonds averaged over its directions (B-9).
struct StripCost {
  double dissipated = 0.0;  ///< along the path of the events
  double released = 0.0;    ///< by the bonds that broke
  int events = 0;
  Index unknowns = 0;
};

/// Area is counted by stiffness: between that of a strip cut plane to `skipped` periods and that of
/// one cut to `skipped + counted`, the crack has grown by as much whatever its path.
StripCost measure_crack_cost(const Strip& strip);

/// Ratio of Lame's constants of bonds in plane stress, of Poisson's ratio nu.
double lame_ratio_of(double poissons_ratio);

}  // namespace perilink::verification
