#include "analysis/explicit_flow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace perilink {
namespace {

constexpr double most_flow = 0.01;           ///< of a stretch in a step (2018, below Eq. 29)
constexpr double softening_per_step = 0.99;  ///< of the yield stress (2018, below Eq. 24)

/// Strain of an isotropic solid under a stress.
SymmetricTensor elastic_strain(double e, double nu, const SymmetricTensor& stress) {
  const double trace = stress[0] + stress[1] + stress[2];
  SymmetricTensor strain{};
  for (int c = 0; c < 6; ++c) {
    strain[c] = ((1.0 + nu) * stress[c] - (c < 3 ? nu * trace : 0.0)) / e;
  }
  return strain;
}

/// In-plane strain without stress of a particle with this plastic strain: that out of the plane
/// cannot happen in plane strain and presses the sides apart.
SymmetricTensor free_strain(Problem problem, double nu, SymmetricTensor plastic) {
  if (problem != Problem::plane_strain) return plastic;
  plastic[0] += nu * plastic[2];
  plastic[1] += nu * plastic[2];
  return plastic;
}

}  // namespace

LatticeYielding::Change LatticeYielding::flow(ExplicitState& state, Index row, Index slot,
                                              double time_step) const {
  const Family family = particles_.family(row, slot);
  return model_.rules == LatticeRules::consistent ? flow_consistently(state, family, time_step)
                                                  : flow_as_printed(state, family, time_step);
}

/// Work of the force states against the change of the plastic stretches, sum_j L_j F_j dp_j / 2,
/// with the mean of the forces of this and the last step (as the integrator sees them), less what
/// the change itself takes off them.
double LatticeYielding::dissipation(const ExplicitState& state, const Family& family,
                                    const Halves& change, double time_step) const {
  const LatticeRows& lattice = model_.lattice;
  Halves middle = particles_.elastic(state, family);  // of the three
  for (int j = 0; j < family.bonds; ++j) {
    if (!family.has(j)) continue;
    const double length = lattice.bonds[family.own_number(j)].length;
    middle[j] -= 0.5 * (time_step * state.rate[family.at[j]] / length + change[j]);
  }
  const Halves force = particles_.forces_of(state, family, middle);
  double work = 0.0;
  for (int j = 0; j < family.bonds; ++j) {
    work += 0.5 * lattice.bonds[family.own_number(j)].length * force[j] * change[j];
  }
  return work;
}

void LatticeYielding::add(ExplicitState& state, const Family& family, const Halves& change) const {
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) state.flow.stretch[model_.lattice.at(j, family.slot)] += change[j];
  }
}

LatticeYielding::Change LatticeYielding::flow_consistently(ExplicitState& state,
                                                           const Family& family,
                                                           double time_step) const {
  const LatticeMaterial& material = model_.material;
  const double e = material.youngs_modulus, nu = material.poissons_ratio;
  const Index slot = family.slot;
  const SymmetricTensor stress = particles_.stress(state, family);
  if (mises_stress(stress) <= state.flow.yield[slot]) return {};
  PlasticState& plastic = state.flow.state[slot];
  SymmetricTensor strain = elastic_strain(e, nu, stress);
  for (int c = 0; c < 6; ++c) strain[c] += plastic.strain[c];
  return_stress(model_.problem, e, nu, material.yielding, strain, plastic);
  state.flow.yield[slot] = yield_stress(material.yielding, plastic.equivalent_strain);
  state.flow.visit[slot] = state.flow.yield[slot];
  if (model_.problem == Problem::plane_strain) state.flow.normal[slot] = e * plastic.strain[2];
  Halves change = particles_.project(free_strain(model_.problem, nu, plastic.strain), family);
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) change[j] -= state.flow.stretch[model_.lattice.at(j, slot)];
  }
  const Change result{true, false, dissipation(state, family, change, time_step)};
  add(state, family, change);
  return result;
}

/// The smaller one of the two force states where they agree in sign, else their mean.
LatticeYielding::Halves LatticeYielding::bond_forces(const ExplicitState& state,
                                                     const Family& family,
                                                     const Halves& own) const {
  Halves bond{};
  for (int j = 0; j < family.bonds; ++j) {
    if (!family.has(j)) continue;
    const Index at = family.at[j];
    const double half = state.stretch[at] - family.side(j) * state.flow.half[at];
    const double other =
        model_.own_modulus(family.own_number(j)) * LatticeParticles::factor(state, at) * half +
        model_.moduli.sum * state.sum[family.partner[j]];
    const double smaller = std::abs(own[j]) < std::abs(other) ? own[j] : other;
    bond[j] = own[j] * other > 0.0 ? smaller : 0.5 * (own[j] + other);
  }
  return bond;
}

/// 2018, Eq. 25
double LatticeYielding::printed_strain(const ExplicitState& state, const Family& family) const {
  Halves halves{};
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) halves[j] = state.flow.stretch[model_.lattice.at(j, family.slot)];
  }
  const PrincipalValues strain =
      principal_values(particles_.fit(halves, family), model_.lattice.dim);
  const double e1 = strain.first, e2 = strain.last;
  return std::sqrt(e1 * e1 - e1 * e2 + e2 * e2);
}

double LatticeYielding::plastic_strain(const ExplicitState& state, Index row, Index slot) const {
  return model_.rules == LatticeRules::consistent
             ? state.flow.state[slot].equivalent_strain
             : printed_strain(state, particles_.family(row, slot));
}

double LatticeYielding::printed_yield(const ExplicitState& state, const Family& family,
                                      bool& beyond) const {
  const YieldCurve& curve = model_.material.yielding;
  const double slope = (curve.ultimate - curve.yield) / curve.ultimate_strain;
  if (model_.rules == LatticeRules::least_2018) {  // Eq. 24
    const double strain = printed_strain(state, family), before = state.flow.yield[family.slot];
    beyond = strain >= curve.ultimate_strain;
    return beyond ? softening_per_step * before : std::max(before, curve.yield + slope * strain);
  }
  // 2017, Eqs. 4.15 and 4.17, with the strain that is there, not with its plastic part
  Halves halves{};
  for (int j = 0; j < family.bonds; ++j) {
    const Index at = family.at[j];
    if (family.has(j)) halves[j] = state.stretch[at] + state.flow.mean[at];
  }
  const PrincipalValues values =
      principal_values(particles_.fit(halves, family), model_.lattice.dim);
  const double e1 = values.first, e2 = values.middle, nu = model_.material.poissons_ratio;
  double e3 = values.last;
  if (model_.problem == Problem::plane_stress) e3 = -nu / (1.0 - nu) * (e1 + e2);
  if (model_.problem == Problem::plane_strain) e3 = 0.0;
  const double strain =
      std::sqrt(0.5 * ((e1 - e2) * (e1 - e2) + (e2 - e3) * (e2 - e3) + (e3 - e1) * (e3 - e1)));
  beyond = strain > curve.ultimate_strain;
  return curve.yield + slope * strain;
}

LatticeYielding::Change LatticeYielding::flow_as_printed(ExplicitState& state, const Family& family,
                                                         double time_step) const {
  const bool of_2017 = model_.rules == LatticeRules::mean_2017;
  const Index slot = family.slot;
  bool beyond = false;
  const double next = printed_yield(state, family, beyond);
  const double yield = of_2017 ? next : state.flow.yield[slot];
  Change result;
  result.crushed = of_2017 && beyond && state.flow.crushed[slot] == 0;
  if (result.crushed) state.flow.crushed[slot] = 1;
  state.flow.yield[slot] = next;
  // By the rules of 2017 the yield stress follows the strain and has to be asked for every time;
  // by those of 2018 it falls in every step once it falls.
  state.flow.visit[slot] = of_2017 ? model_.material.yielding.yield : beyond ? -1.0 : next;
  const double mises = mises_stress(particles_.stress(state, family));
  if (mises <= yield) return result;
  Halves force = particles_.forces(state, family);
  if (!of_2017) force = bond_forces(state, family, force);
  double sum = 0.0, square = 0.0;
  int count = 0;
  for (int j = 0; j < family.bonds; ++j) {
    sum += force[j];
    count += family.has(j) ? 1 : 0;
  }
  Halves change{};
  for (int j = 0; j < family.bonds; ++j) {
    if (family.has(j)) change[j] = force[j] - sum / count;
    square += change[j] * change[j];
  }
  if (square == 0.0) return result;  // equal forces: the printed rule does not flow
  const LatticeMaterial& material = model_.material;
  const double excess = mises / yield * (mises / yield) - 1.0;
  double amount = material.yielding.yield / material.youngs_modulus * excess;
  if (!of_2017) amount = std::min(amount, most_flow);
  for (double& entry : change) entry *= amount / std::sqrt(square);
  result.flowed = true;
  result.dissipated = dissipation(state, family, change, time_step);
  add(state, family, change);
  return result;
}

void LatticeYielding::update_bonds(ExplicitState& state, Index r) const {
  const LatticeRows& lattice = model_.lattice;
  const LatticeRow& row = lattice.rows[r];
  const int own = lattice.own_bonds();
  const bool own_halves = model_.rules != LatticeRules::mean_2017;
  double locked = 0.0;
  for (int k = 0; k < own; ++k) {
    const Index shift = lattice.shift_out[r * own + k];
    double energy = 0.0;
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      const Index at = lattice.at(k, slot);
      if (lattice.present[at] == 0.0) continue;
      const double mine = state.flow.stretch[at];
      const double other = state.flow.stretch[lattice.at(k + own, slot + shift)];
      const double mean = 0.5 * (mine + other);
      state.stretch[at] += state.flow.mean[at] - mean;
      state.flow.mean[at] = mean;
      if (!own_halves) continue;
      const double half = 0.5 * (other - mine);
      state.flow.half[at] = half;
      energy += state.in_tension[at] * half * half;
    }
    locked += 0.5 * lattice.bonds[k].length * model_.own_modulus(k) * energy;
  }
  state.flow.locked[r] = locked;
  state.duty[r] |= RowDuty::altered;
}

void LatticeYielding::update_sums(ExplicitState& state, Index r) const {
  state.duty[r] |= RowDuty::altered;
  if (model_.rules == LatticeRules::mean_2017) return;
  const LatticeRows& lattice = model_.lattice;
  const LatticeRow& row = lattice.rows[r];
  const int own = lattice.own_bonds();
  std::fill_n(state.flow.sum.begin() + row.first, row.size, 0.0);
  for (int k = 0; k < own; ++k) {
    const double weight = lattice.bonds[k].length / lattice.spacing;
    const Index back = lattice.shift_in[r * own + k];
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      const Index out = lattice.at(k, slot), in = out - back;
      state.flow.sum[slot] += weight * (state.in_tension[out] * state.flow.half[out] -
                                        state.in_tension[in] * state.flow.half[in]);
    }
  }
}

}  // namespace perilink
