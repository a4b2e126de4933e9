#pragma once

#include "analysis/explicit_damage.hpp"
#include "analysis/explicit_flow.hpp"

namespace perilink {

/// Damage and flow of a step, in stages over rows. A row's stage may run on any thread; which rows
/// must be done before is said with each.
class LatticeChanges {
 public:
  explicit LatticeChanges(const ExplicitModel& model)
      : model_(model),
        particles_(model),
        damage_(model, particles_),
        yielding_(model, particles_) {}

  /// First: what happens to the particles of a row. After the sums of the row and those next to
  /// it; before any later stage of them.
  void look(ExplicitState& state, Index row) const;
  /// Whether bonds or sums of the row change; after `look` at it and the rows next to it.
  bool touches(const ExplicitState& state, Index row) const;
  /// The later stages, where touched, each after the one before of the row and those next to it:
  /// damage becomes what was noted, and the energy before the change is counted;
  void commit(ExplicitState& state, Index row, double time_step) const;
  /// own bonds take the plastic stretches of their particles;
  void update_plastic_bonds(ExplicitState& state, Index row) const;
  /// sums take them, and the energy that flow cost is counted;
  void update_plastic_sums(ExplicitState& state, Index row, double time_step) const;
  /// own bonds take the factors of the damage of their particles;
  void update_factors(ExplicitState& state, Index row) const;
  /// sums take these, and the energy that damage cost is counted.
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
