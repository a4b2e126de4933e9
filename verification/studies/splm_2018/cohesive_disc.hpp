#pragma once

#include "material/crack_opening.hpp"

/// \file
/// What the disc should bear by its own law of crack opening: a continuum without particles.

namespace perilink::verification {

/// A disc in plane stress between two platens without friction. It may crack along the diameter
/// between them only, by a law of stress over opening; elsewhere it is elastic.
struct CohesiveDisc {
  double radius = 0.0;       ///< [length]
  double thickness = 0.0;    ///< [length]
  double half_platen = 0.0;  ///< half of the width that a platen covers [length]
  double youngs_modulus = 0.0;
  double poissons_ratio = 0.0;
  CrackOpeningLaw law;
};

struct SplittingLoad {
  double first_crack = 0.0;   ///< force at which the diameter first has the strength [force]
  double peak = 0.0;          ///< first maximum of the force while the platens approach [force]
  double displacement = 0.0;  ///< displacement of either platen at the peak [length]
  double opening = 0.0;       ///< largest of the crack at the peak [length]
  double error = 0.0;         ///< largest difference between tension and law along the open crack
                              ///< at the peak, over the strength
  bool sudden = false;  ///< no equilibrium near the peak follows it: the crack runs on its own
};

/// A quarter of the disc by bilinear finite elements, condensed to the diameter and the platen.
/// \param cells  along each side of the quarter
/// \throws std::invalid_argument where no element fits under the platen
/// \throws std::runtime_error where the force only rises
SplittingLoad splitting_load(const CohesiveDisc& disc, int cells);

}  // namespace perilink::verification
