#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "network/network.hpp"

/// \file
/// What the calibration of bonds reached, as users read it.

namespace perilink {

/// One line: largest force out of balance before and after, range of weights, bonds at the floor.
std::string calibration_line(const CalibrationReport& report);

/// Where the equations of calibrated bonds could not be met, and how far; nothing where they are
/// met or nothing is calibrated.
std::optional<std::string> calibration_shortfall(const Network& network);

/// The same numbers for summary.json.
nlohmann::ordered_json calibration_json(const CalibrationReport& report);

}  // namespace perilink
