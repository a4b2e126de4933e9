#pragma once

#include "calibration/calibration_input.hpp"

namespace perilink {

/// Estimate of a calibration that has not been done: the number of free bonds, and the time [s] and
/// memory [bytes] that they take on an idle core at fixed rates.
/// \param moments  whether bonds carry moments
CalibrationReport expected_calibration(const CalibrationInput& input, bool moments);

}  // namespace perilink
