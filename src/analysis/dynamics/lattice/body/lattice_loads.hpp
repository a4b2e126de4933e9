#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Applies forces to particles of a body with prescribed motions. Without prescribed displacements,
/// reactions of supports are summed along the component with the largest sum of forces.
void apply_forces(ExplicitModel& model, const std::vector<AppliedForce>& forces);

/// Adds the change of velocity by forces on one component of a row.
void push(const ExplicitModel& model, Index row, int component, double time, double* speed);

/// Returns the forces on one component of a row at load factor 1 times its velocities before and
/// after a step.
double power(const ExplicitModel& model, Index row, int component, const double* before,
             const double* after);

/// Returns the forces at load factor 1 times the displacements [force length].
double loaded_work(const ExplicitModel& model, const ExplicitState& state);

}  // namespace perilink
