#pragma once

#include "calibration/calibration_input.hpp"

namespace perilink {

/// Estimates a calibration: the number of free bonds, and their time [s] and memory [bytes] at
/// fixed rates on an idle core.
/// \param moments  whether bonds carry moments
CalibrationReport expected_calibration(const CalibrationInput& input, bool moments);

}  // namespace perilink
