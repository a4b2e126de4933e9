#pragma once

#include <span>

#include "calibration/bounded_least_squares/equations/point_equations.hpp"

namespace perilink {

/// Adds A D A' y to result in one pass over the variables, since reading their coefficients
/// dominates the time.
/// \param active_weight  D, per variable
/// \param y         multipliers times the scale, shape (points, rows)
/// \param result    to be multiplied by the scale, shape (points, rows)
/// \tparam Rows, Odd, Grouped  as in bounded_least_squares()
template <int Rows, int Odd, bool Grouped>
void add_system_product(const PointEquations& equations, std::span<const double> active_weight,
                        std::span<const double> y, std::span<double> result);

}  // namespace perilink
