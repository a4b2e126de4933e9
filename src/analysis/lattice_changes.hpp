#pragma once

#include "analysis/explicit_damage.hpp"
#include "analysis/explicit_flow.hpp"

namespace perilink {

/// Damage and flow of a step, in stages over rows, each for all rows once. A row's stage may run on
/// any thread after the stage before it of the row itself and of those rows that are said with
/// each; `near` means within the lattice's reach.
class LatticeChanges {
 public:
  explicit LatticeChanges(const ExplicitModel& model)
      : model_(model),
        particles_(model),
        damage_(model, particles_),
        yielding_(model, particles_) {}

  /// What happens to the particles of a row. After the sums of rows near it on both sides.
  void look(ExplicitState& state, Index row) const;
  /// Notes in near_news whether bonds or sums of the row change: where they do not, the later
  /// stages do nothing. Damage becomes what was noted, and the energy before the change is counted. After rows
  /// near it on both sides.
  void commit(ExplicitState& state, Index row, double time_step) const;
  /// Own bonds take the plastic stretches of their particles. After the rows near it that follow.
  void update_plastic_bonds(ExplicitState& state, Index row) const;
  /// Sums take them, and the energy that flow cost is counted. After the rows near it that precede.
  void update_plastic_sums(ExplicitState& state, Index row, double time_step) const;
  /// Own bonds take the factors of the damage of their particles. After the rows near it that follow.
  void update_factors(ExplicitState& state, Index row) const;
  /// Sums take these, and the energy that damage cost is counted. After the rows near it that precede.
  void update_sums(ExplicitState& state, Index row, double time_step) const;

 private:
  static constexpr std::uint8_t changed = RowNews::damage_grew | RowNews::flowed;
  /// News of the row and of those where its bonds end.
  std::uint8_t outgoing(const ExplicitState& state, Index row) const;
  /// News of the row and of those next to it.
  std::uint8_t around(const ExplicitState& state, Index row) const;
  void flow_at(ExplicitState& state, Index row, Index slot) const;

  const ExplicitModel& model_;
  LatticeParticles particles_;
  LatticeDamage damage_;
  LatticeYielding yielding_;
};

}  // namespace perilink
