#pragma once

#include <span>
#include <vector>

#include "assembly/results/stress_input.hpp"

namespace perilink {

/// Collects what is known of the stress around a particle of the surface, for
/// fit_surface_gradient(): lambda / mu, then for every particle at an unloaded surface its number
/// (0: the particle itself, k: the k-th neighbour), unloaded axes and normal.
/// \param neighbors  of the same material
/// \return whether the particle lies on the surface, its surroundings are intact and unloaded, and
///     stresses are smooth: no re-entrant corner, and no end of a clamped or fully loaded face
bool collect_surface_marks(const StressInput& input, Index particle,
                           std::span<const Index> neighbors, std::vector<double>& marks);

/// Computes the weights of a cubic, else quadratic, polynomial that satisfies the equations of
/// equilibrium without body forces (docs/theory/stress.md). Least squares with equal weights fit it
/// to the displacements and to zero tractions along the unloaded axes of the surface.
/// \param offsets  from the particle to the neighbours, shape (neighbors, Dim) [length]
/// \param marks    of collect_surface_marks()
/// \param weights  shape (neighbors, Dim, Dim, Dim): of displacement c in du_a / dx_b [1/length]
/// \return whether the neighbours determine the gradient
template <int Dim>
bool fit_surface_gradient(std::span<const double> offsets, std::span<const double> marks,
                          std::span<double> weights);

}  // namespace perilink
