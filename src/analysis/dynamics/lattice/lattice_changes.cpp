#include "analysis/dynamics/lattice/lattice_changes.hpp"

#include <algorithm>

#include "analysis/dynamics/lattice/rows/row_energy.hpp"
#include "analysis/dynamics/lattice/rows/row_flow.hpp"
#include "analysis/dynamics/lattice/rows/row_kernels.hpp"
#include "analysis/dynamics/lattice/rows/row_scan.hpp"

namespace perilink {

void LatticeChanges::flow_at(ExplicitState& state, Index row, Index slot) const {
  const LatticeYielding::Change change = yielding_.flow(state, row, slot);
  if (change.flowed) state.row_changes[row] |= RowChanges::flowed;
  state.flow.change[row] = std::max(state.flow.change[row], change.largest);
  if (change.crushed) state.row_changes[row] |= RowChanges::damage_grew;
}

void LatticeChanges::look(ExplicitState& state, Index row) const {
  state.row_changes[row] &= RowChanges::cracked;
  if (!is_scan_due(model_, state, row)) return;
  state.row_changes[row] |= RowChanges::scanned;
  thread_local DueParticles due;
  scan_row(model_, state, row, due);
  // Damage and flow both use the stretches before the change.
  for (const Index slot : due.damage) {
    if (damage_.grow(state, row, slot)) state.row_changes[row] |= RowChanges::damage_grew;
  }
  if (due.flow.empty()) return;
  if (flows_in_rows(model_)) {
    if (flow_row(model_, state, row)) state.row_changes[row] |= RowChanges::flowed;
  } else {
    for (const Index slot : due.flow) flow_at(state, row, slot);
  }
}

std::uint8_t LatticeChanges::outgoing(const ExplicitState& state, Index row) const {
  const LatticeRows& lattice = model_.lattice;
  std::uint8_t bits = state.row_changes[row];
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index out = lattice.row_out[row * lattice.own_bonds() + k];
    if (out != no_index) bits |= state.row_changes[out];
  }
  return bits & changed;
}

std::uint8_t LatticeChanges::around(const ExplicitState& state, Index row) const {
  const LatticeRows& lattice = model_.lattice;
  std::uint8_t bits = outgoing(state, row);
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index in = lattice.row_in[row * lattice.own_bonds() + k];
    if (in != no_index) bits |= state.row_changes[in];
  }
  return bits & changed;
}

void LatticeChanges::commit(ExplicitState& state, Index r, double time_step) const {
  state.near_changes[r] = around(state, r);
  if (state.near_changes[r] == 0) return;
  const double before = half_step_energy(model_, state, r, time_step);
  const bool flows = (state.near_changes[r] & RowChanges::flowed) != 0;
  (flows ? state.sums[r].plastic : state.sums[r].fractured) += before;
  if ((state.row_changes[r] & RowChanges::damage_grew) == 0) return;
  const LatticeRow& row = model_.lattice.rows[r];
  std::copy_n(state.next_damage.begin() + row.first, row.size, state.damage.begin() + row.first);
}

void LatticeChanges::update_plastic_bonds(ExplicitState& state, Index row) const {
  if (state.near_changes[row] == 0 || (outgoing(state, row) & RowChanges::flowed) == 0) return;
  update_plastic_parts(model_, state, row);
  apply_factors(model_, state, row);
}

void LatticeChanges::update_plastic_sums(ExplicitState& state, Index row, double time_step) const {
  const std::uint8_t bits = state.near_changes[row];
  if ((bits & RowChanges::flowed) != 0) {
    add_plastic_halves(model_, state, row);
    sum_stretches(model_, state, row);
    const double after = half_step_energy(model_, state, row, time_step);
    state.sums[row].plastic -= after;
    if ((bits & RowChanges::damage_grew) != 0) state.sums[row].fractured += after;
    state.slack[row] = 0.0;
  }
  // The roots change after the last stage: there, bonds of earlier rows and the energy of flow
  // still use the old roots. The next stage of those bonds uses the new roots.
  if ((state.row_changes[row] & RowChanges::damage_grew) != 0) damage_.update_roots(state, row);
}

void LatticeChanges::update_factors(ExplicitState& state, Index row) const {
  if (state.near_changes[row] == 0 || (outgoing(state, row) & RowChanges::damage_grew) == 0) return;
  damage_.update_factors(state, row);
  if (model_.material.yields) lock_energy(model_, state, row);
  apply_factors(model_, state, row);
}

void LatticeChanges::update_sums(ExplicitState& state, Index row, double time_step) const {
  if ((state.near_changes[row] & RowChanges::damage_grew) == 0) return;
  if (model_.material.yields) add_plastic_halves(model_, state, row);
  sum_stretches(model_, state, row);
  state.sums[row].fractured -= half_step_energy(model_, state, row, time_step);
  state.slack[row] = 0.0;
}

void LatticeChanges::rebuild(ExplicitState& state) const {
  state.next_damage = state.damage;
  for (Index row = 0; row < static_cast<Index>(model_.lattice.rows.size()); ++row) {
    damage_.update_roots(state, row);
    if ((state.bond_changes[row] & BondChanges::weakened) != 0) {
      damage_.update_factors(state, row);
    }
  }
}

}  // namespace perilink
