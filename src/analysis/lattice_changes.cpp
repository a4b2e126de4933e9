#include "analysis/lattice_changes.hpp"

#include <algorithm>

#include "analysis/explicit_energy.hpp"
#include "analysis/explicit_kernels.hpp"
#include "analysis/explicit_scan.hpp"

namespace perilink {

void LatticeChanges::look(ExplicitState& state, Index row, double time_step) const {
  state.duty[row] &= static_cast<std::uint8_t>(~changed);
  if (!is_scan_due(model_, state, row)) return;
  thread_local std::vector<Index> due;
  scan_row(model_, particles_, state, row, due);
  RowSums& sums = state.sums[row];
  for (const Index slot : due) {
    if (model_.material.yields) {
      const LatticeYielding::Change change = yielding_.flow(state, row, slot, time_step);
      if (change.flowed) state.duty[row] |= RowDuty::flowed;
      if (change.crushed) {
        state.duty[row] |= RowDuty::damage_grew;
        state.next_damage[slot] = state.damage[slot];
      }
      if (model_.material.breakable) {  // else all that is lost is plastic
        sums.plastic += change.dissipated;
        sums.fractured -= change.dissipated;
      }
    }
    if (model_.material.breakable && damage_.grow(state, row, slot)) {
      state.duty[row] |= RowDuty::damage_grew;
    }
  }
}

std::uint8_t LatticeChanges::outgoing(const ExplicitState& state, Index row) const {
  const LatticeRows& lattice = model_.lattice;
  std::uint8_t bits = state.duty[row];
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index out = lattice.row_out[row * lattice.own_bonds() + k];
    if (out != no_index) bits |= state.duty[out];
  }
  return bits;
}

bool LatticeChanges::touches(const ExplicitState& state, Index row) const {
  const LatticeRows& lattice = model_.lattice;
  std::uint8_t bits = outgoing(state, row);
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index in = lattice.row_in[row * lattice.own_bonds() + k];
    if (in != no_index) bits |= state.duty[in];
  }
  return (bits & changed) != 0;
}

void LatticeChanges::commit(ExplicitState& state, Index r, double time_step) const {
  const double before = half_step_energy(model_, state, r, time_step);
  (model_.material.breakable ? state.sums[r].fractured : state.sums[r].plastic) += before;
  if ((state.duty[r] & RowDuty::damage_grew) == 0) return;
  const LatticeRow& row = model_.lattice.rows[r];
  std::copy_n(state.next_damage.begin() + row.first, row.size, state.damage.begin() + row.first);
}

void LatticeChanges::update_bonds(ExplicitState& state, Index row) const {
  const std::uint8_t bits = outgoing(state, row);
  if ((bits & changed) == 0) return;
  if ((bits & RowDuty::damage_grew) != 0) damage_.update_factors(state, row);
  if (model_.material.yields) yielding_.update_bonds(state, row);
  apply_factors(model_, state, row);
}

void LatticeChanges::update_sums(ExplicitState& state, Index row, double time_step) const {
  if (model_.material.yields) yielding_.update_sums(state, row);
  sum_stretches(model_, state, row);
  const double after = half_step_energy(model_, state, row, time_step);
  (model_.material.breakable ? state.sums[row].fractured : state.sums[row].plastic) -= after;
  state.slack[row] = 0.0;
}

}  // namespace perilink
