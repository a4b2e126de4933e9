#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// The stages of a time step, each for one row of particles. Every stage writes only what belongs
/// to its row. A row's sums need the bonds of the rows whose bonds end there, its forces the sums
/// of the rows where its bonds end, its motion the forces of all these; and no row may move before
/// the bonds that end there are measured.

namespace perilink {

/// Stretches, directions and rates of the own bonds from displacements and velocities; the work of
/// the damping forces of the last step over the motion that followed.
void measure_bonds(const ExplicitModel& model, ExplicitState& state, Index row, double time_step);

/// Sums of effective stretches of the particles.
void sum_stretches(const ExplicitModel& model, ExplicitState& state, Index row);

/// effective = stretch times the factor of the bond's damage.
void apply_factors(const ExplicitModel& model, ExplicitState& state, Index row);

/// Forces of the own bonds on their owners, damping included.
void bond_forces(const ExplicitModel& model, ExplicitState& state, Index row);

/// Euler–Cromer: velocities from forces, then displacements from velocities. Forces act times
/// `load_factor`, prescribed components move by amplitude times `load_increment`; reactions and
/// work are summed.
void advance(const ExplicitModel& model, ExplicitState& state, Index row, double time_step,
             double load_factor, double load_increment);

}  // namespace perilink
