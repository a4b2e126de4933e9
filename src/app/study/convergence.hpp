#pragma once

#include <array>
#include <optional>
#include <span>

#include "discretization/particles.hpp"

/// \file
/// Errors of a solution and how they fall with the spacing.

namespace perilink {

/// sqrt(sum V |u - u*|^2 / sum V |u*|^2) over the solid particles.
/// \param displacement          u, shape (particles, dim) [length]
/// \param exact                 u*, the same shape
/// \param without_rigid_motion  first takes out the rigid motion that fits u - u* best in the same
///                              norm: for bodies whose supports are not those of the closed form
double relative_l2_error(const Particles& particles, std::span<const double> displacement,
                         std::span<const double> exact, bool without_rigid_motion);

/// Takes the translation and infinitesimal rotation that fit a field best, weighted with the
/// volumes of the solid particles, out of it.
/// \param field  shape (particles, dim)
void remove_rigid_motion(const Particles& particles, std::span<double> field);

/// p in error = C spacing^p through two points; not-a-number where an error is not positive or the
/// spacings are equal.
double observed_order(double coarse_spacing, double coarse_error, double fine_spacing,
                      double fine_error);

/// The limit of a value for vanishing spacing, and how it is approached.
struct Extrapolation {
  double limit = 0.0;
  double order = 0.0;
};

/// Richardson's extrapolation from three spacings (Roache 1994, also for ratios that differ):
/// value = limit + C spacing^order through the three points.
/// \param spacings  coarse to fine, descending
/// \return nothing where the values do not approach a limit: oscillating, or an order below 0.1 or
///         above 10
std::optional<Extrapolation> extrapolate(const std::array<double, 3>& spacings,
                                         const std::array<double, 3>& values);

}  // namespace perilink
