#include "analysis/explicit_damage.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analysis/explicit_kernels.hpp"

namespace perilink {
namespace {

constexpr int own_bonds = 3;  // of the hexagonal lattice

}  // namespace

PrincipalValues principal_values(const PlaneTensor& tensor) {
  const double mean = 0.5 * (tensor.xx + tensor.yy), half = 0.5 * (tensor.xx - tensor.yy);
  const double radius = std::hypot(half, tensor.xy);
  const double angle = 0.5 * std::atan2(tensor.xy, half);
  return {mean + radius, mean - radius, {std::cos(angle), std::sin(angle), 0.0}};
}

LatticeDamage::LatticeDamage(const ExplicitModel& model) : model_(model) {
  using Stretches = Eigen::Matrix<double, 6, 3>;
  for (unsigned mask = 0; mask < 64; ++mask) {
    Stretches rows = Stretches::Zero();
    for (int j = 0; j < 6; ++j) {
      const Vector3& n = model.lattice.bonds[j % own_bonds].direction;
      if ((mask >> j & 1U) != 0U) rows.row(j) << n[0] * n[0], n[1] * n[1], n[0] * n[1];
    }
    const Eigen::Matrix<double, 3, 6> inverse =
        rows.completeOrthogonalDecomposition().pseudoInverse();
    std::copy_n(inverse.data(), 18, inverse_[mask].begin());
  }
}

LatticeDamage::Family LatticeDamage::family(Index row, Index slot) const {
  const LatticeRows& lattice = model_.lattice;
  Family family;
  for (int k = 0; k < own_bonds; ++k) {
    family.bond[k] = slot;
    family.partner[k] = slot + lattice.shift_out[row * own_bonds + k];
    const Index source = slot - lattice.shift_in[row * own_bonds + k];
    family.bond[k + own_bonds] = family.partner[k + own_bonds] = source;
    if (lattice.present[lattice.at(k, slot)] > 0.0) family.mask |= 1U << k;
    if (lattice.present[lattice.at(k, source)] > 0.0) family.mask |= 1U << (k + own_bonds);
  }
  return family;
}

PlaneTensor LatticeDamage::stress(const ExplicitState& state, Index row, Index slot) const {
  const LatticeRows& lattice = model_.lattice;
  const Family bonds = family(row, slot);
  const double shared = model_.moduli.sum * state.sum[slot];
  PlaneTensor stress;
  for (int j = 0; j < 6; ++j) {
    if ((bonds.mask >> j & 1U) == 0U) continue;
    const int k = j % own_bonds;
    const Index at = lattice.at(k, bonds.bond[j]);
    double part = shared;
    if (model_.rules == LatticeRules::consistent) {
      part *= state.stretch[at] >= 0.0 ? state.in_tension[at] : state.in_compression[at];
    }
    const Vector3& n = lattice.bonds[k].direction;
    const double force = 0.5 * lattice.bonds[k].length / model_.volume[slot] *
                         (model_.moduli.own * state.effective[at] + part);
    stress.xx += force * n[0] * n[0];
    stress.yy += force * n[1] * n[1];
    stress.xy += force * n[0] * n[1];
  }
  return stress;
}

PlaneTensor LatticeDamage::fit(const std::array<double, 6>& stretch, unsigned mask) const {
  const auto& inverse = inverse_[mask];
  double strain[3] = {};
  for (int j = 0; j < 6; ++j) {
    for (int c = 0; c < 3; ++c) strain[c] += inverse[3 * j + c] * stretch[j];
  }
  return {strain[0], strain[1], 0.5 * strain[2]};  // the third is the shear angle
}

std::array<double, 6> LatticeDamage::half_stretches(const ExplicitState& state,
                                                    const Family& family, Index slot) const {
  const double threshold = model_.material.compressive_threshold;
  const auto shown = [&](Index particle, bool pulls) {
    const double damage = state.damage[particle];
    return pulls ? damage : compressive_damage(damage, threshold);
  };
  std::array<double, 6> half{};
  for (int j = 0; j < 6; ++j) {
    if ((family.mask >> j & 1U) == 0U) continue;
    const double stretch = state.stretch[model_.lattice.at(j % own_bonds, family.bond[j])];
    const bool pulls = stretch >= 0.0;
    half[j] =
        stretch * (model_.rules == LatticeRules::mean_2017
                       ? 1.0
                       : half_bond_share(shown(slot, pulls), shown(family.partner[j], pulls)));
  }
  return half;
}

bool LatticeDamage::begins(const ExplicitState& state, Index row, Index slot, const Family& family,
                           PrincipalValues& principal) const {
  const LatticeMaterial& material = model_.material;
  PlaneTensor tensor = stress(state, row, slot);
  principal = principal_values(tensor);
  double scale = 1.0, normal = 0.0;
  if (family.mask != 63U) scale = material.boundary_factor;
  if (model_.problem == Problem::plane_strain)
    normal = material.poissons_ratio * (tensor.xx + tensor.yy);
  return scale * principal.first > material.softening.strength &&
         scale * std::min(principal.second, normal) >
             -material.tension_compression_ratio * material.softening.strength;
}

double LatticeDamage::damage_of(const ExplicitState& state, Index slot,
                                const Family& family) const {
  const LatticeMaterial& material = model_.material;
  const double e = material.youngs_modulus, spacing = model_.lattice.spacing;
  const PlaneTensor strain = fit(half_stretches(state, family, slot), family.mask);
  const PrincipalValues principal = principal_values(strain);
  const double e1 = principal.first, e2 = principal.second;
  switch (model_.rules) {
    case LatticeRules::mean_2017:
      return printed_damage(material.softening, e, e1, 2.0 * spacing * e1);
    case LatticeRules::least_2018: {
      const double crack = std::sqrt(e1 * e1 - e1 * e2 + e2 * e2);
      return printed_damage(material.softening, e, crack, spacing * crack);
    }
    case LatticeRules::consistent: {
      // The stress that an intact particle of this strain would carry, as a uniaxial strain.
      const HookeConstants hooke = hooke_constants(model_.problem, e, material.poissons_ratio);
      const double effective = (hooke.lambda * (e1 + e2) + 2.0 * hooke.mu * e1) / e;
      return band_damage(material.softening, e, effective, state.crack_band[slot]);
    }
  }
  return 0.0;
}

void LatticeDamage::grow_row(ExplicitState& state, Index r) const {
  state.changed[r] = 0;
  if (state.cracked[r] == 0 && state.tension_bound[r] <= model_.material.softening.strength) return;
  const LatticeRow& row = model_.lattice.rows[r];
  for (Index slot = row.first; slot < row.first + row.size; ++slot) {
    if (model_.inverse_mass[slot] == 0.0 || state.damage[slot] >= 1.0) continue;
    const Family bonds = family(r, slot);
    if (state.crack_band[slot] == 0.0) {
      PrincipalValues principal;
      if (!begins(state, r, slot, bonds, principal)) continue;
      state.crack_band[slot] = band_width(model_, principal.direction);
      state.cracked[r] = 1;
    }
    const double damage = damage_of(state, slot, bonds);
    if (damage <= state.damage[slot]) continue;
    state.next_damage[slot] = damage;
    state.changed[r] = 1;
  }
}

void LatticeDamage::mark_touched(ExplicitState& state) const {
  const LatticeRows& lattice = model_.lattice;
  const auto rows = static_cast<Index>(lattice.rows.size());
  std::fill(state.touched.begin(), state.touched.end(), std::uint8_t{0});
  for (Index r = 0; r < rows; ++r) {
    bool factors = state.changed[r] != 0;
    for (int k = 0; k < own_bonds; ++k) {
      const Index out = lattice.row_out[r * own_bonds + k];
      factors = factors || (out != no_index && state.changed[out] != 0);
    }
    if (!factors) continue;
    state.touched[r] |= 2U;  // own bonds
    state.touched[r] |= 1U;  // sums of stretches
    for (int k = 0; k < own_bonds; ++k) {
      const Index out = lattice.row_out[r * own_bonds + k];
      if (out != no_index) state.touched[out] |= 1U;
    }
  }
}

void LatticeDamage::update_factors(ExplicitState& state, Index r) const {
  const LatticeRows& lattice = model_.lattice;
  const LatticeRow& row = lattice.rows[r];
  const double threshold = model_.material.compressive_threshold;
  for (int k = 0; k < own_bonds; ++k) {
    const Index shift = lattice.shift_out[r * own_bonds + k];
    for (Index slot = row.first; slot < row.first + row.size; ++slot) {
      const Index at = lattice.at(k, slot);
      const double mine = state.damage[slot], other = state.damage[slot + shift];
      if (lattice.present[at] == 0.0 || (mine == 0.0 && other == 0.0)) continue;
      state.in_tension[at] = two_spring_factor(mine, other);
      state.in_compression[at] = two_spring_factor(compressive_damage(mine, threshold),
                                                   compressive_damage(other, threshold));
    }
  }
}

double LatticeDamage::half_step_energy(const ExplicitState& state, Index r, double dt) const {
  const LatticeRows& lattice = model_.lattice;
  const LatticeRow& row = lattice.rows[r];
  double energy = 0.0;
  for (Index slot = row.first; slot < row.first + row.size; ++slot) {
    const Family bonds = family(r, slot);
    double sum = 0.0, sum_before = 0.0;
    for (int j = 0; j < 6; ++j) {
      if ((bonds.mask >> j & 1U) == 0U) continue;
      const Index at = lattice.at(j % own_bonds, bonds.bond[j]);
      const double stretch = state.stretch[at];
      const double before = stretch - dt * state.rate[at] / lattice.spacing;
      const double factor = stretch >= 0.0 ? state.in_tension[at] : state.in_compression[at];
      sum += factor * stretch;
      sum_before += factor * before;
      if (j >= own_bonds) continue;
      energy += 0.5 * lattice.spacing * model_.moduli.own * factor * stretch * before;
    }
    energy += 0.25 * lattice.spacing * model_.moduli.sum * sum * sum_before;
  }
  return energy;
}

void LatticeDamage::grow(ExplicitState& state, double time_step) const {
  const auto rows = static_cast<Index>(model_.lattice.rows.size());
#pragma omp for schedule(static)
  for (Index r = 0; r < rows; ++r) {
    bound_tension(model_, state, r);
    grow_row(state, r);
  }
  if (std::none_of(state.changed.begin(), state.changed.end(), [](auto c) { return c != 0; })) {
    return;
  }
#pragma omp single
  {
    mark_touched(state);
    for (Index r = 0; r < rows; ++r) {
      if (state.changed[r] == 0) continue;
      const LatticeRow& row = model_.lattice.rows[r];
      std::copy_n(state.next_damage.begin() + row.first, row.size,
                  state.damage.begin() + row.first);
    }
  }
#pragma omp for schedule(static)
  for (Index r = 0; r < rows; ++r) {
    if (state.touched[r] != 0) state.sums[r].fractured += half_step_energy(state, r, time_step);
  }
#pragma omp for schedule(static)
  for (Index r = 0; r < rows; ++r) {
    if ((state.touched[r] & 2U) == 0U) continue;
    update_factors(state, r);
    apply_factors(model_, state, r);
  }
#pragma omp for schedule(static)
  for (Index r = 0; r < rows; ++r) {
    if (state.touched[r] == 0) continue;
    sum_stretches(model_, state, r);
    state.sums[r].fractured -= half_step_energy(state, r, time_step);
  }
}

}  // namespace perilink
