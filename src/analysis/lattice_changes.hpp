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

  /// First: what happens to the particles of a row. After the sums of the row; before any later
  /// stage of it and of rows next to it.
  void look(ExplicitState& state, Index row, double time_step) const;
  /// Whether bonds or sums of the row change; after `look` at it and the rows next to it.
  bool touches(const ExplicitState& state, Index row) const;
  /// Second, where touched: damage becomes what was noted, and the energy before the change is
  /// counted. After `look` at the row and those next to it.
  void commit(ExplicitState& state, Index row, double time_step) const;
  /// Third, where touched: own bonds. After the commits of the row and those next to it.
  void update_bonds(ExplicitState& state, Index row) const;
  /// Fourth, where touched: sums, and the energy lost. After `update_bonds` of the row and those
  /// whose bonds end in it.
  void update_sums(ExplicitState& state, Index row, double time_step) const;

 private:
  static constexpr std::uint8_t changed = RowDuty::damage_grew | RowDuty::flowed;
  /// Bits of the row and of those where its bonds end.
  std::uint8_t outgoing(const ExplicitState& state, Index row) const;

  const ExplicitModel& model_;
  LatticeParticles particles_;
  LatticeDamage damage_;
  LatticeYielding yielding_;
};

}  // namespace perilink
