#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Plastic flow of whole rows, in loops that the compiler vectorises.

namespace perilink {

/// Returns whether flow_row() can replace LatticeYielding: consistent rules in the plane.
bool flows_in_rows(const ExplicitModel& model);

/// Returns particles of a row above the yield surface to it by backward Euler with the associated
/// flow: projected in plane stress, radial in plane strain.
/// \returns whether a particle yielded
bool flow_row(const ExplicitModel& model, ExplicitState& state, Index row);

/// Updates plastic parts of the own bonds of a row from the halves of their particles; the
/// stretches change accordingly.
void update_plastic_parts(const ExplicitModel& model, ExplicitState& state, Index row);

/// Computes the energy of the halves of the own bonds of a row (LatticeFlow::locked), with the
/// present factors.
void lock_energy(const ExplicitModel& model, ExplicitState& state, Index row);

/// Computes the contributions of halves of bonds to the sums of a row's particles
/// (LatticeFlow::sum).
void add_plastic_halves(const ExplicitModel& model, ExplicitState& state, Index row);

}  // namespace perilink
