#pragma once

#include "analysis/dynamics/lattice/lattice_damage.hpp"
#include "analysis/dynamics/lattice/lattice_flow.hpp"

namespace perilink {

/// Damage and flow of a step, in stages over rows, each for all rows once. A row's stage may run on
/// any thread after the stage before it of the row itself and of rows near it, within the lattice's
/// reach: before it, after it or both.
class LatticeChanges {
 public:
  explicit LatticeChanges(const ExplicitModel& model)
      : model_(model),
        particles_(model),
        damage_(model, particles_),
        yielding_(model, particles_) {}

  /// Finds what happens to the particles of a row. Needs the sums of rows on both sides.
  void look(ExplicitState& state, Index row) const;
  /// Notes in near_changes whether bonds or sums of the row change: where they do not, the later
  /// stages do nothing. Damage becomes what was noted, and the energy before the change is
  /// counted. Needs rows on both sides.
  void commit(ExplicitState& state, Index row, double time_step) const;
  /// Own bonds take the plastic stretches of their particles. Needs rows after it, where the body
  /// yields.
  void update_plastic_bonds(ExplicitState& state, Index row) const;
  /// Sums take the plastic stretches, and the energy that flow cost is counted. Needs rows before
  /// it, where the body yields.
  void update_plastic_sums(ExplicitState& state, Index row, double time_step) const;
  /// Own bonds take the factors of the damage of their particles. Needs rows after it.
  void update_factors(ExplicitState& state, Index row) const;
  /// Sums take the factors, and the energy that damage cost is counted. Needs rows before it.
  void update_sums(ExplicitState& state, Index row, double time_step) const;

 private:
  static constexpr std::uint8_t changed = RowChanges::damage_grew | RowChanges::flowed;
  /// Bits of RowChanges of the row and of those where its bonds end.
  std::uint8_t outgoing(const ExplicitState& state, Index row) const;
  /// Bits of RowChanges of the row and of those next to it.
  std::uint8_t around(const ExplicitState& state, Index row) const;
  void flow_at(ExplicitState& state, Index row, Index slot) const;

  const ExplicitModel& model_;
  LatticeParticles particles_;
  LatticeDamage damage_;
  LatticeYielding yielding_;
};

}  // namespace perilink
