#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

#include <Eigen/Dense>
#include <unordered_map>

#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Rows and columns of the entries of a SymmetricTensor.
constexpr std::array<std::array<int, 2>, 6> axes = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Returns the entries of a SymmetricTensor in the plane or in space.
std::vector<int> entries_of(int dim) {
  return dim == 2 ? std::vector<int>{0, 1, 3} : std::vector<int>{0, 1, 2, 3, 4, 5};
}

double product_of(const Vector3& n, int entry) { return n[axes[entry][0]] * n[axes[entry][1]]; }

}  // namespace

LatticeParticles::LatticeParticles(const ExplicitModel& model) : model_(model) {
  const LatticeRows& lattice = model.lattice;
  whole_ = (1U << (2 * lattice.own_bonds())) - 1U;
  kind_.assign(lattice.slots, 0);
  std::unordered_map<std::uint32_t, std::uint32_t> known;
  for_each_particle(lattice, [&](Index row, Index slot) {
    const std::uint32_t mask = neighbourhood(row, slot).mask;
    const auto [place, fresh] = known.emplace(mask, static_cast<std::uint32_t>(inverses_.size()));
    if (fresh) inverses_.push_back(invert(mask));
    kind_[slot] = place->second;
  });
  find_faces();
}

void LatticeParticles::find_faces() {
  const LatticeRows& lattice = model_.lattice;
  near_face_.assign(lattice.slots, 0);
  for_each_particle(lattice, [&](Index row, Index slot) {
    const Neighbourhood around = neighbourhood(row, slot);
    near_face_[slot] = is_whole(around) ? 0 : 1;
    for (int j = 0; j < around.bonds && near_face_[slot] == 0; ++j) {
      near_face_[slot] = lattice.bond_count[around.partner[j]] < around.bonds ? 1 : 0;
    }
  });
}

LatticeParticles::Inverse LatticeParticles::invert(std::uint32_t mask) const {
  const std::vector<int> entries = entries_of(model_.lattice.dim);
  const int own = model_.lattice.own_bonds();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * own, static_cast<Index>(entries.size()));
  for (int j = 0; j < 2 * own; ++j) {
    const Vector3& n = model_.lattice.bonds[j % own].direction;
    for (std::size_t c = 0; c < entries.size() && (mask >> j & 1U) != 0U; ++c) {
      // Entries off the diagonal count twice.
      rows(j, static_cast<Index>(c)) = (entries[c] < 3 ? 1.0 : 2.0) * product_of(n, entries[c]);
    }
  }
  const Eigen::MatrixXd inverse = pseudo_inverse(rows);
  return {inverse.data(), inverse.data() + inverse.size()};
}

LatticeParticles::Neighbourhood LatticeParticles::neighbourhood(Index row, Index slot) const {
  const LatticeRows& lattice = model_.lattice;
  const int own = lattice.own_bonds();
  Neighbourhood neighbourhood;
  neighbourhood.slot = slot;
  neighbourhood.bonds = 2 * own;
  for (int k = 0; k < own; ++k) {
    const Index source = slot - lattice.shift_in[row * own + k];
    neighbourhood.at[k] = lattice.at(k, slot);
    neighbourhood.at[k + own] = lattice.at(k, source);
    neighbourhood.partner[k] = slot + lattice.shift_out[row * own + k];
    neighbourhood.partner[k + own] = source;
    if (lattice.present[neighbourhood.at[k]] > 0.0) neighbourhood.mask |= 1U << k;
    if (lattice.present[neighbourhood.at[k + own]] > 0.0) neighbourhood.mask |= 1U << (k + own);
  }
  return neighbourhood;
}

LatticeParticles::Neighbourhood LatticeParticles::neighbourhood(const ExplicitState& state,
                                                                Index row, Index slot) const {
  const RowPlaces& places = state.now.places;
  Neighbourhood result = neighbourhood(row, slot);
  const int own = result.bonds / 2;
  result.now = places.first[row] + (slot - model_.lattice.rows[row].first);
  for (int k = 0; k < own; ++k) {
    const Index source = result.now - places.shift_in[row * own + k];
    result.now_at[k] = places.at(k, result.now);
    result.now_at[k + own] = places.at(k, source);
    result.now_partner[k] = result.now + places.shift_out[row * own + k];
    result.now_partner[k + own] = source;
  }
  return result;
}

LatticeParticles::Halves LatticeParticles::elastic_at(double end, const ExplicitState& state,
                                                      const Neighbourhood& neighbourhood) const {
  Halves half{};
  const StepNumbers& now = state.now;
  const std::vector<double>& stretch = now.stretch.empty() ? now.effective : now.stretch;
  const bool own_halves = model_.material.yields && model_.rules != LatticeRules::mean_2017;
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    half[j] = stretch[neighbourhood.now_at[j]];
    if (own_halves) half[j] += end * neighbourhood.side(j) * state.flow.half[neighbourhood.at[j]];
  }
  return half;
}

LatticeParticles::Halves LatticeParticles::elastic(const ExplicitState& state,
                                                   const Neighbourhood& neighbourhood) const {
  return elastic_at(1.0, state, neighbourhood);
}

LatticeParticles::Halves LatticeParticles::shared(const ExplicitState& state,
                                                  const Neighbourhood& neighbourhood) const {
  Halves half = elastic(state, neighbourhood);
  if (model_.rules == LatticeRules::mean_2017) return half;
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    const Index at = neighbourhood.at[j];
    const double whole = state.now.stretch[neighbourhood.now_at[j]];
    const double owners = whole >= 0.0 ? state.share_tension[at] : state.share_compression[at];
    half[j] += neighbourhood.side(j) * (owners - 1.0) * whole;  // the partner has 2 - owners
  }
  return half;
}

double LatticeParticles::factor(const ExplicitState& state, const Neighbourhood& neighbourhood,
                                int bond) {
  const std::vector<double>& stretch = state.now.stretch;
  if (stretch.empty()) return 1.0;
  const Index at = neighbourhood.at[bond];
  return stretch[neighbourhood.now_at[bond]] >= 0.0 ? state.in_tension[at]
                                                    : state.in_compression[at];
}

double LatticeParticles::root(const ExplicitState& state, const Neighbourhood& neighbourhood,
                              int bond) {
  const std::vector<double>& stretch = state.now.stretch;
  if (stretch.empty()) return 1.0;
  const bool stretches = stretch[neighbourhood.now_at[bond]] >= 0.0;
  return (stretches ? state.root_tension : state.root_compression)[neighbourhood.slot];
}

LatticeParticles::Halves LatticeParticles::forces(const ExplicitState& state,
                                                  const Neighbourhood& neighbourhood) const {
  const Halves half = elastic(state, neighbourhood);
  const double shared = model_.moduli.sum * state.now.sum[neighbourhood.now];
  Halves force{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    const double weaker = factor(state, neighbourhood, j);
    const double part = root(state, neighbourhood, j) * shared;
    force[j] = model_.own_modulus(neighbourhood.own_number(j)) * weaker * half[j] + part;
  }
  return force;
}

LatticeParticles::Halves LatticeParticles::partner_forces(
    const ExplicitState& state, const Neighbourhood& neighbourhood) const {
  const Halves half = elastic_at(-1.0, state, neighbourhood);
  Halves force{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    if (!neighbourhood.has(j)) continue;
    const double stiffness =
        model_.own_modulus(neighbourhood.own_number(j)) * factor(state, neighbourhood, j);
    force[j] =
        stiffness * half[j] + model_.moduli.sum * state.now.sum[neighbourhood.now_partner[j]];
  }
  return force;
}

SymmetricTensor LatticeParticles::bond_stress(const Neighbourhood& neighbourhood,
                                              const Halves& force) const {
  SymmetricTensor stress{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    const OwnBond& bond = model_.lattice.bonds[neighbourhood.own_number(j)];
    const double share = 0.5 * bond.length * force[j] / model_.volume[neighbourhood.slot];
    for (int c = 0; c < 6; ++c) stress[c] += share * product_of(bond.direction, c);
  }
  if (model_.problem == Problem::plane_strain) {
    stress[2] = model_.material.poissons_ratio * (stress[0] + stress[1]);
  }
  return stress;
}

SymmetricTensor LatticeParticles::stress(const ExplicitState& state,
                                         const Neighbourhood& neighbourhood,
                                         const Halves& force) const {
  SymmetricTensor stress = bond_stress(neighbourhood, force);
  if (model_.problem == Problem::plane_strain && model_.material.yields) {
    stress[2] -= state.flow.normal[neighbourhood.slot];
  }
  return stress;
}

SymmetricTensor LatticeParticles::mean_stress(const ExplicitState& state,
                                              const Neighbourhood& around, Index row,
                                              double& volume, int& count) const {
  const LatticeRows& lattice = model_.lattice;
  const int own = lattice.own_bonds();
  SymmetricTensor sum{};
  volume = 0.0;
  count = 0;
  const auto add = [&](const Neighbourhood& each) {
    const double weight = model_.volume[each.slot];
    const SymmetricTensor stress = bond_stress(each, forces(state, each));
    for (int c = 0; c < 6; ++c) sum[c] += weight * stress[c];
    volume += weight;
    ++count;
  };
  add(around);
  for (int j = 0; j < around.bonds; ++j) {
    if (!around.has(j)) continue;
    const Index k = row * own + around.own_number(j);
    const Index other = j < own ? lattice.row_out[k] : lattice.row_in[k];
    add(neighbourhood(state, other, around.partner[j]));
  }
  for (double& entry : sum) entry /= volume;
  return sum;
}

SymmetricTensor LatticeParticles::fit(const Halves& stretch,
                                      const Neighbourhood& neighbourhood) const {
  const Inverse& inverse = inverse_of(neighbourhood);
  SymmetricTensor strain{};
  if (neighbourhood.bonds == 6) {
    for (int j = 0; j < 6; ++j) {
      strain[0] += inverse[3 * j] * stretch[j];
      strain[1] += inverse[3 * j + 1] * stretch[j];
      strain[3] += inverse[3 * j + 2] * stretch[j];
    }
    return strain;
  }
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    for (int c = 0; c < 6; ++c) strain[c] += inverse[6 * j + c] * stretch[j];
  }
  return strain;
}

LatticeParticles::Halves LatticeParticles::project(const SymmetricTensor& strain,
                                                   const Neighbourhood& neighbourhood) const {
  Halves stretch{};
  for (int j = 0; j < neighbourhood.bonds; ++j) {
    const Vector3& n = model_.lattice.bonds[neighbourhood.own_number(j)].direction;
    for (int c = 0; c < 6 && neighbourhood.has(j); ++c) {
      stretch[j] += (c < 3 ? 1.0 : 2.0) * strain[c] * product_of(n, c);
    }
  }
  return stretch;
}

}  // namespace perilink
