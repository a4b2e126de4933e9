#include "analysis/dynamics/lattice/lattice_damage.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/lattice/rows/row_scan.hpp"

namespace perilink {
bool LatticeDamage::begins(ExplicitState& state, Index row, const Neighbourhood& neighbourhood,
                           Vector3& normal) const {
  const LatticeMaterial& material = model_.material;
  // Particles near a face use the mean stress of their neighbourhood: along a jagged face, stresses
  // of outer and inner particles alternate in sign.
  const bool consistent = model_.rules == LatticeRules::consistent;
  const bool averaged = consistent && particles_.is_near_face(neighbourhood.slot);
  double volume = 0.0;
  int count = 0;
  const SymmetricTensor stress =
      averaged ? particles_.mean_stress(state, neighbourhood, row, volume, count)
               : particles_.stress(state, neighbourhood);
  const PrincipalValues principal = principal_values(stress, model_.lattice.dim);
  const double scale = particles_.is_whole(neighbourhood) ? 1.0 : material.boundary_factor;
  const double least = std::min(principal.last, stress[2]);
  if (begins_crack(material.softening, scale * principal.first, scale * least)) {
    normal = principal_direction(stress, model_.lattice.dim);
    return true;
  }
  if (averaged && !has_weakened_rows(model_, state, row)) {
    const double rest = (material.softening.strength / scale - principal.first) * volume;
    state.quiet_until[neighbourhood.slot] =
        state.path[row] + rest / (count * stress_stiffness(model_));
  }
  return false;
}

double LatticeDamage::driving_strain(const ExplicitState& state,
                                     const Neighbourhood& neighbourhood) const {
  const LatticeMaterial& material = model_.material;
  if (follows_stress(neighbourhood)) {
    const PrincipalValues stress =
        principal_values(particles_.stress(state, neighbourhood), model_.lattice.dim);
    return stress.first / ((1.0 - state.damage[neighbourhood.slot]) * material.youngs_modulus);
  }
  const SymmetricTensor strain =
      particles_.fit(particles_.shared(state, neighbourhood), neighbourhood);
  const PrincipalValues values = principal_values(strain, model_.lattice.dim);
  const double e1 = values.first, e2 = values.last;
  switch (model_.rules) {
    case LatticeRules::mean_2017: return e1;
    case LatticeRules::least_2018: return std::sqrt(e1 * e1 - e1 * e2 + e2 * e2);
    case LatticeRules::consistent: {
      const HookeConstants hooke = hooke_constants(model_.problem, 1.0, material.poissons_ratio);
      return hooke.lambda * (strain[0] + strain[1] + strain[2]) + 2.0 * hooke.mu * e1;
    }
  }
  return 0.0;
}

double LatticeDamage::damage_at(double strain, double band) const {
  const LatticeMaterial& material = model_.material;
  const double e = material.youngs_modulus, spacing = model_.lattice.spacing;
  switch (model_.rules) {
    case LatticeRules::mean_2017:
      return printed_damage(material.softening, e, strain, 2.0 * spacing * strain);
    case LatticeRules::least_2018:
      return printed_damage(material.softening, e, strain, spacing * strain);
    case LatticeRules::consistent: return band_damage(material.softening, e, strain, band);
  }
  return 0.0;
}

bool LatticeDamage::follows_stress(const Neighbourhood& neighbourhood) const {
  return model_.rules == LatticeRules::consistent && particles_.is_whole(neighbourhood);
}

void LatticeDamage::watch(ExplicitState& state, const Neighbourhood& neighbourhood, double strain,
                          double damage) const {
  const Index slot = neighbourhood.slot;
  double& next = state.crack_at[slot];
  if (damage >= 1.0) {
    next = never;
  } else if (follows_stress(neighbourhood)) {
    // A mean stress may have started the crack while the particle's own stress is below the
    // strength.
    const double cohesive = (1.0 - damage) * model_.material.youngs_modulus * strain;
    next = damage > 0.0 ? cohesive : model_.material.softening.strength;
  } else {
    // Damage rises with the strain. Only particles with all bonds have a threshold of strain.
    const bool counted = model_.lattice.dim == 2 && particles_.is_whole(neighbourhood);
    next = counted ? strain : -never;
  }
}

bool LatticeDamage::grow(ExplicitState& state, Index row, Index slot) const {
  if (state.damage[slot] >= 1.0) return false;
  const Neighbourhood neighbourhood = particles_.neighbourhood(state, row, slot);
  const bool first = state.crack_band[slot] == 0.0;
  if (first) {
    Vector3 normal{};
    if (!begins(state, row, neighbourhood, normal)) return false;
    state.crack_band[slot] = band_width(model_, normal);
    state.crack_at[slot] = never;
    state.quiet_until[slot] = -never;
    state.row_changes[row] |= RowChanges::cracked;
  }
  const double strain = driving_strain(state, neighbourhood);
  const double damage = damage_at(strain, state.crack_band[slot]);
  const bool grows = damage > state.damage[slot];
  if (model_.rules == LatticeRules::consistent && (first || grows)) {
    watch(state, neighbourhood, strain, std::max(damage, state.damage[slot]));
  }
  if (grows && state.damage[slot] == 0.0) state.cracked_in[slot] = state.step;
  if (grows) state.next_damage[slot] = damage;
  return grows;
}

void LatticeDamage::update_roots(ExplicitState& state, Index r) const {
  if (!model_.weighs_halves()) return;
  const LatticeRow& row = model_.lattice.rows[r];
  const double threshold = model_.material.compressive_threshold;
  for (Index slot = row.first; slot < row.first + row.size; ++slot) {
    const double damage = state.damage[slot];
    state.root_tension[slot] = std::sqrt(1.0 - damage);
    state.root_compression[slot] = std::sqrt(1.0 - compressive_damage(damage, threshold));
  }
}

void LatticeDamage::update_factors(ExplicitState& state, Index r) const {
  const LatticeRows& lattice = model_.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double threshold = model_.material.compressive_threshold;
  const auto is_crushed = [&](Index slot) {
    return !state.flow.crushed.empty() && state.flow.crushed[slot] != 0;
  };
  const auto in_compression = [&](Index slot) {
    return is_crushed(slot) ? 1.0 : compressive_damage(state.damage[slot], threshold);
  };
  for (int k = 0; k < lattice.own_bonds(); ++k) {
    const Index shift = lattice.shift_out[r * lattice.own_bonds() + k];
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      const Index at = lattice.at(k, slot), partner = slot + shift;
      const double mine = state.damage[slot], other = state.damage[partner];
      if (mine == 0.0 && other == 0.0 && !is_crushed(slot) && !is_crushed(partner)) continue;
      if (lattice.present[at] == 0.0) continue;
      const double mine_pressed = in_compression(slot), other_pressed = in_compression(partner);
      state.in_tension[at] = two_spring_factor(mine, other);
      state.in_compression[at] = two_spring_factor(mine_pressed, other_pressed);
      state.share_tension[at] = half_bond_share(mine, other);
      state.share_compression[at] = half_bond_share(mine_pressed, other_pressed);
    }
  }
  state.bond_changes[r] |= BondChanges::altered | BondChanges::weakened;
}

}  // namespace perilink
