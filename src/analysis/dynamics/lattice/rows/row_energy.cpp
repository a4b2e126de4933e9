#include "analysis/dynamics/lattice/rows/row_energy.hpp"

#include "analysis/dynamics/lattice/rows/bond_pointers.hpp"
#include "analysis/dynamics/lattice/rows/row_scan.hpp"

namespace perilink {
namespace {

/// Computes the stored energy of a row. Sums of the last step follow from the present ones and the
/// rates.
/// \param Weakened  bonds have factors, chosen by the present signs of their stretches
/// \param Weighs    sums have separate weights
template <int Bonds, bool Weakened, bool Weighs>
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index r,
                        double dt) {
  constexpr int own = Bonds / 2;
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const BondPointers<Bonds> bond(model, state, r);
  const double* sums = state.now.sum.data() + state.now.places.first[r];
  double half[own], back[own];
  for (int k = 0; k < own; ++k) {
    const double length = lattice.bonds[k].length;
    half[k] = 0.5 * length * model.own_modulus(k);
    back[k] = dt / length;
  }
  const double quarter = 0.25 * lattice.spacing * model.moduli.sum;
  const double weighted_back = dt / lattice.spacing;
  const double* root_tension = Weighs ? state.root_tension.data() + row.first : nullptr;
  const double* root_compression = Weighs ? state.root_compression.data() + row.first : nullptr;
  double energy = 0.0;
#pragma omp simd reduction(+ : energy)
  for (Index i = 0; i < row.size; ++i) {
    double rates = 0.0;
#pragma GCC unroll 18
    for (int j = 0; j < Bonds; ++j) {
      const int k = j % own;
      double rate = bond.rate[j][i];  // absent bonds have zero stretch and rate
      if constexpr (Weighs) {
        const double s = bond.stretch[j][i];
        const double share = by_sign(s, bond.share_tension[j][i], bond.share_compression[j][i]);
        rate *= (j < own ? share : 2.0 - share) * by_sign(s, root_tension[i], root_compression[i]);
      } else if constexpr (Weakened) {
        rate *= by_sign(bond.stretch[j][i], bond.tension[j][i], bond.compression[j][i]);
      }
      rates += rate;
      if (j >= own) continue;
      const double stretch = Weakened ? bond.stretch[j][i] : bond.effective[j][i];
      energy += half[k] * bond.effective[j][i] * (stretch - back[k] * bond.rate[j][i]);
    }
    energy += quarter * sums[i] * (sums[i] - weighted_back * rates);
  }
  return energy + (model.material.yields ? state.flow.locked[r] : 0.0);
}

template <int Bonds>
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double dt) {
  const bool weakened = (changes_of_bonds(model.lattice, state, row) & BondChanges::weakened) != 0;
  if (!weakened) return half_step_energy<Bonds, false, false>(model, state, row, dt);
  return model.weighs_halves() ? half_step_energy<Bonds, true, true>(model, state, row, dt)
                               : half_step_energy<Bonds, true, false>(model, state, row, dt);
}

}  // namespace

double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double time_step) {
  return model.lattice.dim == 2 ? half_step_energy<6>(model, state, row, time_step)
                                : half_step_energy<18>(model, state, row, time_step);
}

double kinetic_energy(const ExplicitModel& model, const ExplicitState& state, Index r) {
  const LatticeRow& row = model.lattice.rows[r];
  const double* mass = model.mass.data() + row.first;
  double energy = 0.0;
  for (int c = 0; c < model.lattice.dim; ++c) {
    const double* v = state.velocity.data() + model.lattice.at(c, row.first);
#pragma omp simd reduction(+ : energy)
    for (Index i = 0; i < row.size; ++i) energy += 0.5 * mass[i] * v[i] * v[i];
  }
  return energy;
}

}  // namespace perilink
