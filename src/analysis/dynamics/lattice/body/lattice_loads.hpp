#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

namespace perilink {

/// Applies forces to particles of a body whose motions are prescribed already. Where nothing is
/// driven, the reaction of supports is summed along the component with the largest sum of forces.
void apply_forces(ExplicitModel& model, const std::vector<AppliedForce>& forces);

/// Adds what the forces on one component of a row add to its new velocities.
/// \param time   step times load factor
/// \param speed  per slot of the row
void push(const ExplicitModel& model, Index row, int component, double time, double* speed);

/// Forces on one component of a row at load factor 1 times its velocities before and after a step.
double power(const ExplicitModel& model, Index row, int component, const double* before,
             const double* after);

/// Forces at load factor 1 times the displacements [force length].
double loaded_work(const ExplicitModel& model, const ExplicitState& state);

}  // namespace perilink
