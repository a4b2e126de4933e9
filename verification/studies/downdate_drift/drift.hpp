#pragma once

#include <vector>

#include "model/from_case/configure.hpp"

namespace perilink::verification {

/// Accuracy after so many downdates.
struct Drift {
  int downdates = 0;
  double residual = 0.0;      ///< |f - K u| / |f|, u moved along by every downdate
  double error = 0.0;         ///< |u - fresh| / |fresh|, fresh: factorised anew
  double factor_error = 0.0;  ///< |K^-1 f - fresh| / |fresh| with the downdated factor
};

/// Removes bonds of the model drawn at random (fixed seed; a bond whose pivot is below 1/100 stays,
/// so that nothing comes loose) through the in-place factor, without refinement or refactorisation,
/// and measures every `interval` downdates.
std::vector<Drift> measure_drift(const Model& model, int downdates, int interval);

/// What cutting a part out of the body does to the rest.
struct Detachment {
  int particles = 0;   ///< in the part
  int bonds = 0;       ///< bonds that held it
  int springs = 0;     ///< ground springs that the engine added
  double error = 0.0;  ///< in what remains, against a fresh factor without the part
};

/// Cuts out all particles within `radius` spacings of the one nearest to the point.
Detachment measure_detachment(const Model& model, double x, double y, double radius);

}  // namespace perilink::verification
