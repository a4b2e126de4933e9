#pragma once

#include <span>
#include <vector>

#include "assembly/results/stress_input.hpp"

/// \file
/// Stresses at the particles of an intact or damaged body.

namespace perilink {

/// Returns the stress at a particle by Hooke's law for its strain [force/length^2]
/// (docs/theory/stress.md).
///
/// Where all bonds of the particle are intact, the strain is the gradient of a quadratic
/// polynomial that has the particle's own displacement at the particle. Least squares with weights
/// 1/distance^2 fit the polynomial to the displacements of the neighbours of the same material.
/// The strain is exact for quadratic fields, also at the surface. Where the neighbours do not
/// determine a quadratic polynomial, a linear one is fitted. Where they do not determine a linear
/// one, the stress is zero. At surfaces with known conditions the polynomial is cubic and in
/// equilibrium, see fit_surface_gradient().
///
/// Where a bond of the particle is damaged, the strain is bond_strain(), from the forces that its
/// bonds still carry. In plane strain zz = lambda (e_xx + e_yy).
/// \param motion  shape (particles, width)
Stress stress_at(const StressInput& input, std::span<const double> motion, Index particle);

/// Returns the stresses at all particles, zero for particles that are not solid;
/// shape (particles, 6).
std::vector<double> particle_stresses(const StressInput& input, std::span<const double> motion);

}  // namespace perilink
