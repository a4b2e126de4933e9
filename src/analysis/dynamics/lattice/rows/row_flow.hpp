#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Flow of whole rows, in loops that the compiler vectorises.

namespace perilink {

/// Whether flow_row does what LatticeYielding does: consistent rules in the plane.
bool flows_in_rows(const ExplicitModel& model);

/// Returns the particles of a row to the yield surface that are above it, by backward Euler with
/// the associated flow: projected in plane stress, radial in plane strain.
/// \returns whether any was
bool flow_row(const ExplicitModel& model, ExplicitState& state, Index row);

/// Plastic parts of the own bonds of a row from those of their particles' halves; the stretches
/// follow.
void update_plastic_parts(const ExplicitModel& model, ExplicitState& state, Index row);

/// Energy of the halves of the own bonds of a row (LatticeFlow::locked), with the present factors.
void lock_energy(const ExplicitModel& model, ExplicitState& state, Index row);

/// What the halves of its bonds add to the sums of a row's particles (LatticeFlow::sum).
void add_plastic_halves(const ExplicitModel& model, ExplicitState& state, Index row);

}  // namespace perilink
