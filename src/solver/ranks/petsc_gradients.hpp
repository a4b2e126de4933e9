#pragma once

#include <span>

#include "solver/ranks.hpp"

namespace perilink {

/// Ranks::conjugate_gradients() by a KSP of PETSc without a matrix. It ends as
/// perilink::conjugate_gradients() does; options of PETSc (-ksp_type, -ksp_view, -ksp_monitor ...)
/// go past it. Methods other than cg end where they have reduced their residual to `enough`.
/// \throws NotPositiveDefinite where the system is not
GradientsReport petsc_gradients(Ranks& ranks, const LinearMap& product,
                                const LinearMap& precondition, std::span<const double> right,
                                std::span<double> solution, double enough, double scale,
                                int most_iterations);

}  // namespace perilink
