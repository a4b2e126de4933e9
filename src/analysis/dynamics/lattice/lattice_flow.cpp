#include "analysis/dynamics/lattice/lattice_flow.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// Largest plastic change of a stretch in a step (2018, below Eq. 29).
constexpr double most_flow = 0.01;
/// Largest fall of the yield stress in a step, as a factor (2018, below Eq. 24).
constexpr double softening_per_step = 0.99;

/// Returns the elastic strain of an isotropic solid under a stress.
SymmetricTensor elastic_strain(double e, double nu, const SymmetricTensor& stress) {
  const double trace = stress[0] + stress[1] + stress[2];
  SymmetricTensor strain{};
  for (int c = 0; c < 6; ++c) {
    strain[c] = ((1.0 + nu) * stress[c] - (c < 3 ? nu * trace : 0.0)) / e;
  }
  return strain;
}

/// Returns the stress-free in-plane strain of a particle with a plastic strain. In plane strain the
/// prevented out-of-plane part adds in-plane strain.
SymmetricTensor free_strain(Problem problem, double nu, SymmetricTensor plastic) {
  if (problem != Problem::plane_strain) return plastic;
  plastic[0] += nu * plastic[2];
  plastic[1] += nu * plastic[2];
  return plastic;
}

}  // namespace

LatticeYielding::Change LatticeYielding::flow(ExplicitState& state, Index row, Index slot) const {
  const Neighbourhood neighbourhood = particles_.neighbourhood(state, row, slot);
  switch (model_.rules) {
    case LatticeRules::mean_2017: return flow_as_in_2017(state, neighbourhood);
    case LatticeRules::least_2018: return flow_as_in_2018(state, neighbourhood);
    case LatticeRules::consistent: break;
  }
  return flow_consistently(state, neighbourhood);
}

LatticeYielding::Change LatticeYielding::flow_consistently(
    ExplicitState& state, const Neighbourhood& neighbourhood) const {
  const LatticeMaterial& material = model_.material;
  const double e = material.youngs_modulus, nu = material.poissons_ratio;
  const Index slot = neighbourhood.slot;
  const SymmetricTensor stress = particles_.stress(state, neighbourhood);
  if (mises_stress(stress) <= state.flow.yield[slot]) return {};
  PlasticState plastic;
  plastic.equivalent_strain = state.flow.equivalent[slot];
  SymmetricTensor strain = elastic_strain(e, nu, stress);
  for (int c = 0; c < 6; ++c) {
    plastic.strain[c] = state.flow.strain[model_.lattice.at(c, slot)];
    strain[c] += plastic.strain[c];
  }
  return_stress(model_.problem, e, nu, material.yielding, strain, plastic);
  for (int c = 0; c < 6; ++c) state.flow.strain[model_.lattice.at(c, slot)] = plastic.strain[c];
  state.flow.equivalent[slot] = plastic.equivalent_strain;
  state.flow.yield[slot] = yield_stress(material.yielding, plastic.equivalent_strain);
  state.flow.look_at[slot] = state.flow.yield[slot];
  if (model_.problem == Problem::plane_strain) state.flow.normal[slot] = e * plastic.strain[2];
  Change result{true, false, 0.0};
  const Halves stretch =
      particles_.project(free_strain(model_.problem, nu, plastic.strain), neighbourhood);
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    double& present = state.flow.stretch[model_.lattice.at(j, slot)];
    result.largest = std::max(result.largest, std::abs(stretch[j] - present));
    present = stretch[j];
  }
  return result;
}

double LatticeYielding::plastic_strain(const ExplicitState& state, Index row, Index slot) const {
  return model_.rules == LatticeRules::consistent
             ? state.flow.equivalent[slot]
             : present_plastic_strain(state, particles_.neighbourhood(state, row, slot));
}

double LatticeYielding::present_plastic_strain(const ExplicitState& state,
                                               const Neighbourhood& neighbourhood) const {
  Halves halves{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (neighbourhood.has(j))
      halves[j] = state.flow.stretch[model_.lattice.at(j, neighbourhood.slot)];
  }
  const PrincipalValues strain =
      principal_values(particles_.fit(halves, neighbourhood), model_.lattice.dim);
  const double e1 = strain.first, e2 = strain.last;
  return std::sqrt(e1 * e1 - e1 * e2 + e2 * e2);
}

bool LatticeYielding::step_along(const Halves& force, double length, ExplicitState& state,
                                 const Neighbourhood& neighbourhood) const {
  double sum = 0.0, square = 0.0;
  int count = 0;
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    sum += force[j];
    count += neighbourhood.has(j) ? 1 : 0;
  }
  Halves change{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (neighbourhood.has(j)) change[j] = force[j] - sum / count;
    square += change[j] * change[j];
  }
  if (square == 0.0) return false;
  for (double& entry : change) entry *= length / std::sqrt(square);
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (neighbourhood.has(j))
      state.flow.stretch[model_.lattice.at(j, neighbourhood.slot)] += change[j];
  }
  return true;
}

/// Nikravesh 2017, Eqs. 4.15 and 4.17, with the present strain instead of its plastic part.
double LatticeYielding::yield_of_2017(const ExplicitState& state,
                                      const Neighbourhood& neighbourhood, bool& beyond) const {
  const YieldCurve& curve = model_.material.yielding;
  const double slope = (curve.ultimate - curve.yield) / curve.ultimate_strain;
  Halves halves{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    halves[j] = state.now.stretch[neighbourhood.now_at[j]] + state.flow.mean[neighbourhood.at[j]];
  }
  const PrincipalValues values =
      principal_values(particles_.fit(halves, neighbourhood), model_.lattice.dim);
  const double e1 = values.first, e2 = values.middle, nu = model_.material.poissons_ratio;
  double e3 = values.last;
  if (model_.problem == Problem::plane_stress) e3 = -nu / (1.0 - nu) * (e1 + e2);
  if (model_.problem == Problem::plane_strain) e3 = 0.0;
  const double strain =
      std::sqrt(0.5 * ((e1 - e2) * (e1 - e2) + (e2 - e3) * (e2 - e3) + (e3 - e1) * (e3 - e1)));
  beyond = strain > curve.ultimate_strain;
  return curve.yield + slope * strain;
}

LatticeYielding::Change LatticeYielding::flow_as_in_2017(ExplicitState& state,
                                                         const Neighbourhood& neighbourhood) const {
  const Index slot = neighbourhood.slot;
  bool beyond = false;
  const double yield = yield_of_2017(state, neighbourhood, beyond);
  Change result;
  result.crushed = beyond && state.flow.crushed[slot] == 0;
  if (result.crushed) state.flow.crushed[slot] = 1;
  state.flow.yield[slot] = yield;
  // The yield stress depends on the strain, so the particle is checked at every step.
  state.flow.look_at[slot] = model_.material.yielding.yield;
  const Halves force = particles_.forces(state, neighbourhood);
  const double mises = mises_stress(particles_.stress(state, neighbourhood, force));
  if (mises <= yield) return result;
  const LatticeMaterial& material = model_.material;
  const double excess = mises / yield * (mises / yield) - 1.0;
  const double amount = material.yielding.yield / material.youngs_modulus * excess;
  result.flowed = step_along(force, amount, state, neighbourhood);
  return result;
}

void LatticeYielding::harden_as_in_2018(ExplicitState& state,
                                        const Neighbourhood& neighbourhood) const {
  const YieldCurve& curve = model_.material.yielding;
  const double slope = (curve.ultimate - curve.yield) / curve.ultimate_strain;
  const double strain = present_plastic_strain(state, neighbourhood);
  double& yield = state.flow.yield[neighbourhood.slot];
  double& look_at = state.flow.look_at[neighbourhood.slot];
  if (strain >= curve.ultimate_strain) {
    yield *= softening_per_step;
    look_at = -1.0;  // a falling yield stress falls in every step
  } else {
    look_at = yield = std::max(yield, curve.yield + slope * strain);
  }
}

LatticeYielding::Change LatticeYielding::flow_as_in_2018(ExplicitState& state,
                                                         const Neighbourhood& neighbourhood) const {
  const double yield = state.flow.yield[neighbourhood.slot];
  harden_as_in_2018(state, neighbourhood);
  Halves force = particles_.forces(state, neighbourhood);
  const double mises = mises_stress(particles_.stress(state, neighbourhood, force));
  if (mises <= yield) return {};
  // Takes the smaller force state of the two ends where signs agree, else their mean (Eq. 5).
  const Halves other = particles_.partner_forces(state, neighbourhood);
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    const double smaller = std::abs(force[j]) < std::abs(other[j]) ? force[j] : other[j];
    force[j] = force[j] * other[j] > 0.0 ? smaller : 0.5 * (force[j] + other[j]);
  }
  const LatticeMaterial& material = model_.material;
  const double least = material.yielding.yield / material.youngs_modulus, ratio = mises / yield;
  const double amount = std::min(least * (ratio * ratio - 1.0), most_flow);
  return {step_along(force, amount, state, neighbourhood), false, 0.0};
}

}  // namespace perilink
