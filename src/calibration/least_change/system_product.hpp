#pragma once

#include <span>

#include "calibration/least_change/equations/point_equations.hpp"

namespace perilink {

/// result += A D A' y, in one pass over the variables: reading their coefficients is what takes the
/// time.
/// \param mobility  D, per variable
/// \param y         multipliers times the scale, shape (points, rows)
/// \param result    still to be multiplied by the scale, shape (points, rows)
/// \tparam Rows, Odd, Grouped  those of least_change()
template <int Rows, int Odd, bool Grouped>
void add_system_product(const PointEquations& equations, std::span<const double> mobility,
                        std::span<const double> y, std::span<double> result);

}  // namespace perilink
