#pragma once

#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"

namespace perilink {

/// Returns the equations with a column for each unknown, without linearly dependent rows.
/// \param equations  without groups
/// \param kept       empty at first
ReducedEquations reduce(const PointEquations& equations, IndependentRows& kept);

}  // namespace perilink
