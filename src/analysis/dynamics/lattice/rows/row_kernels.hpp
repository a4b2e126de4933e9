#pragma once

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Stages of a time step, each for one row of particles. A stage writes only values of its row.
/// Sums of a row need the rows whose bonds end there. Forces need the sums of rows where its bonds
/// end. Motion needs the forces of all these rows. A row must not move before the bonds that end
/// there are measured.

namespace perilink {

/// Computes stretches, directions and rates of the own bonds from displacements and velocities.
/// Adds the work of the last step's damping forces over the motion that followed.
void measure_bonds(const ExplicitModel& model, ExplicitState& state, Index row, double time_step);

/// Computes the sums of effective stretches of the particles.
void sum_stretches(const ExplicitModel& model, ExplicitState& state, Index row);

/// Computes effective = stretch times damage factor of the bond.
void apply_factors(const ExplicitModel& model, ExplicitState& state, Index row);

/// Computes forces of the own bonds on their owners, damping included.
void bond_forces(const ExplicitModel& model, ExplicitState& state, Index row);

/// Advances by Euler–Cromer: velocities from forces, then displacements from velocities. Forces are
/// multiplied by `load_factor`; prescribed components move by amplitude times `load_increment`.
/// Reactions and work are summed.
void advance(const ExplicitModel& model, ExplicitState& state, Index row, double time_step,
             double load_factor, double load_increment);

}  // namespace perilink
