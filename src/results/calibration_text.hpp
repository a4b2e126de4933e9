#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "network/network.hpp"

/// \file
/// Results of the bond calibration as text and JSON.

namespace perilink {

/// Returns a line with the largest force out of balance before and after, the range of weights and
/// the bonds at the lower bound.
std::string calibration_line(const CalibrationReport& report);

/// Returns the position and size of the largest residual of the calibration; empty where its
/// equations are met or no bond is calibrated.
std::optional<std::string> calibration_shortfall(const Network& network);

/// Returns the calibration report for summary.json.
nlohmann::ordered_json calibration_json(const CalibrationReport& report);

}  // namespace perilink
