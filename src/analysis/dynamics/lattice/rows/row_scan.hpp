#pragma once

#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Which particles of a row have to be looked at. Damage and flow cost nothing until stretches
/// have changed by as much as the particle nearest to a threshold had left when the row was last
/// scanned.

namespace perilink {

/// Whether a row has to be scanned in this step; takes the change of the stretches of its particles
/// and their neighbours off its slack.
bool is_scan_due(const ExplicitModel& model, ExplicitState& state, Index row);

/// Duties of the rows that own bonds of the particles of a row: bits of BondChanges.
std::uint8_t changes_of_bonds(const LatticeRows& lattice, const ExplicitState& state, Index row);

/// Whether bonds of the particles of a row or of their neighbours have factors of damage.
bool has_weakened_rows(const ExplicitModel& model, const ExplicitState& state, Index row);

/// Change of the stress of a particle times its volume per change of its stretches, from above
/// [force length].
double stress_stiffness(const ExplicitModel& model);

/// Slots of a row that have to be looked at.
struct DueParticles {
  std::vector<Index> damage;  ///< first principal stress above crack_at; by the rules of the papers
                              ///< also all particles with a crack
  std::vector<Index> flow;    ///< von Mises stress above flow.look_at
};

/// Finds the particles that have reached the thresholds that the state has for them, exact in the
/// plane, on the safe side in space; and the row's slack. Stretches and sums must be up to date.
void scan_row(const ExplicitModel& model, ExplicitState& state, Index row, DueParticles& due);

}  // namespace perilink
