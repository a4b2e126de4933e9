#pragma once

#include <array>
#include <optional>
#include <span>

#include "discretization/particles.hpp"

/// \file
/// Errors of a solution and their convergence with the spacing.

namespace perilink {

/// Returns sqrt(sum V |u - u*|^2 / sum V |u*|^2) over the solid particles.
/// \param displacement          u, shape (particles, dim) [length]
/// \param exact                 u*, shape (particles, dim) [length]
/// \param without_rigid_motion  first subtracts the rigid motion that fits u - u* best in this
///                              norm: for bodies with supports unlike the closed form
double relative_l2_error(const Particles& particles, std::span<const double> displacement,
                         std::span<const double> exact, bool without_rigid_motion);

/// Subtracts the translation and infinitesimal rotation that fit a field best, weighted by the
/// volumes of the solid particles.
/// \param field  shape (particles, dim)
void remove_rigid_motion(const Particles& particles, std::span<double> field);

/// Returns the order p of error = C spacing^p through two points; not-a-number where an error is
/// not positive or the spacings are equal.
double observed_order(double coarse_spacing, double coarse_error, double fine_spacing,
                      double fine_error);

/// Limit of a value for vanishing spacing, and its order of convergence.
struct Extrapolation {
  double limit = 0.0;
  double order = 0.0;
};

/// Richardson extrapolation from three spacings (Roache 1994, also for unequal ratios): value =
/// limit + C spacing^order through the three points.
/// \param spacings  coarse to fine, descending
/// \return empty where the values approach no limit: oscillating, or an order below 0.1 or
///         above 10
std::optional<Extrapolation> extrapolate(const std::array<double, 3>& spacings,
                                         const std::array<double, 3>& values);

}  // namespace perilink
