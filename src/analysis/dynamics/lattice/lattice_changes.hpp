#pragma once

#include "analysis/dynamics/lattice/lattice_damage.hpp"
#include "analysis/dynamics/lattice/lattice_flow.hpp"

namespace perilink {

/// Damage and flow of a step, in stages over rows, each for all rows once. The stage of a row may
/// run on any thread. It runs after the preceding stage of the row and of rows within the lattice's
/// reach before it, after it or both.
class LatticeChanges {
 public:
  explicit LatticeChanges(const ExplicitModel& model)
      : model_(model),
        particles_(model),
        damage_(model, particles_),
        yielding_(model, particles_) {}

  /// Finds damage and flow of the particles of a row. Needs the sums of rows on both sides.
  void look(ExplicitState& state, Index row) const;
  /// Records in near_changes whether bonds or sums of the row change; otherwise the later stages do
  /// nothing. Applies the recorded damage and adds up the energy before the change. Needs rows on
  /// both sides.
  void commit(ExplicitState& state, Index row, double time_step) const;
  /// Sets plastic stretches of own bonds from their particles. Needs rows after it, where the body
  /// yields.
  void update_plastic_bonds(ExplicitState& state, Index row) const;
  /// Adds plastic stretches to the sums and records the energy lost by flow. Needs rows before it,
  /// where the body yields.
  void update_plastic_sums(ExplicitState& state, Index row, double time_step) const;
  /// Sets factors of own bonds from the damage of their particles. Needs rows after it.
  void update_factors(ExplicitState& state, Index row) const;
  /// Applies the factors to the sums and records the energy lost by damage. Needs rows before it.
  void update_sums(ExplicitState& state, Index row, double time_step) const;
  /// Rebuilds what follows from a saved LatticeState: next damage, roots and factors of all rows.
  void rebuild(ExplicitState& state) const;

 private:
  static constexpr std::uint8_t changed = RowChanges::damage_grew | RowChanges::flowed;
  /// Returns bits of RowChanges of the row and of rows where its bonds end.
  std::uint8_t outgoing(const ExplicitState& state, Index row) const;
  /// Returns bits of RowChanges of the row and of neighbouring rows.
  std::uint8_t around(const ExplicitState& state, Index row) const;
  void flow_at(ExplicitState& state, Index row, Index slot) const;

  const ExplicitModel& model_;
  LatticeParticles particles_;
  LatticeDamage damage_;
  LatticeYielding yielding_;
};

}  // namespace perilink
