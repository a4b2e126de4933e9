#pragma once

#include "calibration/least_change/equations/point_equations.hpp"
#include "calibration/least_change/tied/tied_equations.hpp"

namespace perilink {

/// The equations with a column for each unknown, without rows that follow from others.
/// \param equations  without groups
/// \param kept       empty at first
TiedEquations tie(const PointEquations& equations, TiedRows& kept);

}  // namespace perilink
