#include "analysis/explicit_energy.hpp"

#include "analysis/bond_pointers.hpp"

namespace perilink {
namespace {

template <int Bonds, bool Alters>
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index r,
                        double dt) {
  constexpr int own = Bonds / 2;
  const LatticeRows& lattice = model.lattice;
  const LatticeRow& row = lattice.rows[r];
  const BondPointers<Bonds> bond(model, state, r);
  const bool yields = model.material.yields;
  const double* plastic = yields ? state.flow.sum.data() + row.first : nullptr;
  double weight[own], half[own], back[own];
  for (int k = 0; k < own; ++k) {
    const double length = lattice.bonds[k].length;
    weight[k] = length / lattice.spacing;
    half[k] = 0.5 * length * model.own_modulus(k);
    back[k] = dt / length;
  }
  const double quarter = 0.25 * lattice.spacing * model.moduli.sum;
  double energy = 0.0;
#pragma omp simd reduction(+ : energy)
  for (Index i = 0; i < row.size; ++i) {
    double sum = 0.0, sum_before = 0.0;
#pragma GCC unroll 18
    for (int j = 0; j < Bonds; ++j) {
      const int k = j % own;
      const double stretch = Alters ? bond.stretch[j][i] : bond.effective[j][i];
      const double before = stretch - back[k] * bond.rate[j][i];
      double factor = 1.0;  // what does not exist has neither effective stretch nor rate
      if constexpr (Alters) {
        factor = by_sign(stretch, bond.tension[j][i], bond.compression[j][i]);
      }
      sum += weight[k] * factor * stretch;
      sum_before += weight[k] * factor * before;
      if (j < own) energy += half[k] * factor * stretch * before;
    }
    const double added = yields ? plastic[i] : 0.0;
    energy += quarter * (sum + added) * (sum_before + added);
  }
  return energy + (yields ? state.flow.locked[r] : 0.0);
}

template <int Bonds>
double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double dt) {
  return model.alters() ? half_step_energy<Bonds, true>(model, state, row, dt)
                        : half_step_energy<Bonds, false>(model, state, row, dt);
}

}  // namespace

double half_step_energy(const ExplicitModel& model, const ExplicitState& state, Index row,
                        double time_step) {
  return model.lattice.dim == 2 ? half_step_energy<6>(model, state, row, time_step)
                                : half_step_energy<18>(model, state, row, time_step);
}

}  // namespace perilink
