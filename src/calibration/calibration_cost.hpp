#pragma once

#include "calibration/calibration.hpp"

namespace perilink {

/// The report of a calibration that has not been done: how many bonds it may change, and what it
/// will take on a quiet core, roughly [s], by rates of bodies whose search finds its end
/// (contradictory equations take longer).
/// \param moments  bonds carry them
CalibrationReport expected_calibration(const CalibrationInput& input, bool moments);

}  // namespace perilink
