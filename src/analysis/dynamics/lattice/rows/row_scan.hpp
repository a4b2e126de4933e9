#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Selection of particles of a row to check. A row is scanned only when stretches have changed by
/// the least margin found in its last scan.

namespace perilink {

/// Returns whether a row must be scanned in this step. Reduces its slack by the change of the
/// stretches of its particles and their neighbours.
bool is_scan_due(const ExplicitModel& model, ExplicitState& state, Index row);

/// Returns bits of BondChanges of the rows that own bonds of a row's particles.
std::uint8_t changes_of_bonds(const LatticeRows& lattice, const ExplicitState& state, Index row);

/// Returns whether bonds of a row's particles or of their neighbours have damage factors.
bool has_weakened_rows(const ExplicitModel& model, const ExplicitState& state, Index row);

/// Returns an upper bound of the change of a particle's stress times volume per change of its
/// stretches [force length].
double stress_stiffness(const ExplicitModel& model);

/// Slots of a row to check.
struct DueParticles {
  /// first principal stress above crack_at; also all particles with a crack, unless the rules are
  /// LatticeRules::consistent
  std::vector<Index> damage;
  std::vector<Index> flow;  ///< von Mises stress above flow.look_at
};

/// Finds the particles that have reached their thresholds, exactly in the plane, on the safe side
/// in space. Updates the row's slack. Stretches and sums must be up to date.
void scan_row(const ExplicitModel& model, ExplicitState& state, Index row, DueParticles& due);

}  // namespace perilink
