#pragma once

#include "calibration/calibration.hpp"

namespace perilink {

/// Estimate of a calibration that has not been done, as its report: how many bonds it may change
/// and roughly how many seconds it takes on an idle core, by rates of bodies whose search converges
/// (contradictory equations take longer).
/// \param moments  whether bonds carry moments
CalibrationReport expected_calibration(const CalibrationInput& input, bool moments);

}  // namespace perilink
