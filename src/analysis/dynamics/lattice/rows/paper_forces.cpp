#include "analysis/dynamics/lattice/rows/paper_forces.hpp"

#include <cmath>

#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"

namespace perilink {

void paper_forces(const ExplicitModel& model, ExplicitState& state, Index r) {
  const LatticeRows& lattice = model.lattice;
  const RowPlaces& places = state.now.places;
  StepNumbers& now = state.now;
  const double modulus = model.moduli.sum, damping = model.bond_damping;
  const bool weakened = (state.bond_changes[r] & BondChanges::weakened) != 0;
  const bool flowed = (state.bond_changes[r] & BondChanges::altered) != 0 && model.material.yields;
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const double own = model.own_modulus(k);
    const Index shift = places.shift_out[r * lattice.own_bonds() + k];
    for (Index i = 0; i < lattice.rows[r].size; ++i) {
      const Index slot = places.first[r] + i, bond = places.at(k, slot);
      const Index at = lattice.at(k, lattice.rows[r].first + i);
      const double present = lattice.present[at];
      double factor = present;
      if (weakened) {
        factor = by_sign(now.stretch[bond], state.in_tension[at], state.in_compression[at]);
      }
      const double here = modulus * now.sum[slot];
      const double there = modulus * now.sum[slot + shift];
      double magnitude = own * now.effective[bond];
      if (model.rules == LatticeRules::mean_2017) {
        magnitude = present * (magnitude + 0.5 * (here + there));
      } else {  // 2018, Eq. 5: force states of both ends
        const double excess = flowed ? own * factor * state.flow.half[at] : 0.0;
        const double mine = magnitude + here + excess, other = magnitude + there - excess;
        const double smaller = std::abs(mine) < std::abs(other) ? mine : other;
        magnitude = present * (mine * other > 0.0 ? smaller : 0.5 * (mine + other));
      }
      if (weakened) {
        state.drag[at] = damping * factor * state.rate[at];
        magnitude += state.drag[at];
      } else {
        magnitude += damping * state.rate[at];
      }
      for (int c = 0; c < lattice.dim; ++c) {
        now.force[places.at(k * lattice.dim + c, slot)] *= magnitude;
      }
    }
  }
}

}  // namespace perilink
