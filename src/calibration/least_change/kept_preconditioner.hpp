#pragma once

#include <memory>

#include "calibration/least_change/box_space.hpp"
#include "calibration/least_change/equations_factor.hpp"
#include "calibration/least_change/tied/tied_factor.hpp"

namespace perilink {

/// Made for one problem and good for the next with the same points and about these coefficients.
struct KeptPreconditioner {
  std::unique_ptr<BoxSpace> boxes;
  std::unique_ptr<EquationsFactor> factor;
  std::unique_ptr<TiedFactor> tied;
  TiedRows tied_rows;

  void reset() { *this = {}; }
};

}  // namespace perilink
