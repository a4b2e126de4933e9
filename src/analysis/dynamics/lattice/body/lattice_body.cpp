#include "analysis/dynamics/lattice/body/lattice_body.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace perilink {
namespace {

/// Returns the share of the cell filled by triangles between a particle and its neighbours: a half
/// on a straight edge. In space it is the share of its bonds.
std::vector<double> tributary_shares(const LatticeRows& lattice) {
  std::vector<double> share(lattice.slots, 0.0);
  const int own = lattice.own_bonds();
  for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
    for (Index i = 0; i < lattice.rows[r].size; ++i) {
      const Index slot = lattice.rows[r].first + i;
      if (lattice.dim == 3) {
        share[slot] = lattice.bond_count[slot] / 18.0;
        continue;
      }
      std::array<bool, 6> present{};  // in the order of their angles
      for (int k = 0; k < own; ++k) {
        present[k] = lattice.present[lattice.at(k, slot)] > 0.0;
        const Index source = slot - lattice.shift_in[r * own + k];
        present[k + 3] = lattice.present[lattice.at(k, source)] > 0.0;
      }
      for (int k = 0; k < 6; ++k) share[slot] += (present[k] && present[(k + 1) % 6]) / 6.0;
    }
  }
  return share;
}

/// Corner particles get the mass of particles on straight edges, which keeps the time step long.
constexpr double least_inertia = 0.5;

void set_masses(ExplicitModel& model) {
  const LatticeRows& lattice = model.lattice;
  model.mass.assign(lattice.slots, 1.0);
  model.inverse_mass.assign(lattice.slots, 0.0);
  model.volume.assign(lattice.slots, lattice.cell_volume);
  const std::vector<double> share = tributary_shares(lattice);
  // Share of a particle without a triangle.
  const double least = 1.0 / (lattice.dim == 2 ? 6.0 : 18.0);
  for (const Index slot : lattice.particle_slot) {
    double inertia = 1.0;
    if (model.rules == LatticeRules::consistent) {
      model.volume[slot] = lattice.cell_volume * std::max(share[slot], least);
      inertia = std::max(share[slot], least_inertia);
    }
    model.mass[slot] = model.material.density * lattice.cell_volume * inertia;
    model.inverse_mass[slot] = 1.0 / model.mass[slot];
  }
}

/// Sets damping by Nikravesh (2017, Eqs. 3.55–3.57) with the wavelength 2 L_0 of the hexagonal
/// lattice and the speed sqrt(K / rho).
void set_damping(ExplicitModel& model) {
  const LatticeMaterial& material = model.material;
  const double bulk = material.youngs_modulus / (3.0 * (1.0 - 2.0 * material.poissons_ratio));
  const double frequency =
      std::numbers::pi / model.lattice.spacing * std::sqrt(bulk / material.density);
  model.bond_damping =
      2.0 * material.density * model.lattice.cell_volume * material.internal_damping * frequency;
  if (material.external_damping == 0.0) return;
  if (material.fundamental_period <= 0.0) {
    throw std::invalid_argument("external damping needs the fundamental period of the body");
  }
  model.mass_damping = mass_damping_rate(material.external_damping, material.fundamental_period);
}

/// Returns the widest crack band: half-way between two directions of rows, in space along a face of
/// the cube.
double widest_band(const ExplicitModel& model) {
  const LatticeRows& lattice = model.lattice;
  if (lattice.dim == 3) return lattice.cell_volume / (0.5 * lattice.spacing * lattice.spacing);
  return lattice.cell_volume / (model.thickness * lattice.spacing * 0.5 * std::numbers::sqrt3);
}

void check_damage(const ExplicitModel& model) {
  if (!model.material.breakable) return;
  if (model.lattice.dim == 3 && model.rules == LatticeRules::least_2018) {
    throw std::invalid_argument("the rules of 2018 have no damage in space");
  }
  if (model.rules != LatticeRules::consistent) return;
  const double widest = widest_band(model);
  const double limit = max_band_width(model.material.softening, model.material.youngs_modulus);
  if (widest < limit) return;
  throw std::invalid_argument(fmt::format(
      "the spacing {} is too large for the softening: a crack would release more energy than its "
      "opening dissipates; take less than {}",
      model.lattice.spacing, model.lattice.spacing * limit / widest));
}

/// Sets the softening of the consistent rules by the energy of a band of one row.
void set_softening(ExplicitModel& model) {
  LatticeMaterial& material = model.material;
  if (!material.yields) return;
  if (model.lattice.dim == 3 && model.rules == LatticeRules::least_2018) {
    throw std::invalid_argument("the rules of 2018 have no flow in space");
  }
  if (model.rules != LatticeRules::consistent) return;
  YieldCurve& curve = material.yielding;
  curve.failure_strain = failure_strain(curve, material.crushing_energy, widest_band(model));
  // Flow must reduce stress faster than the yield surface shrinks: 3 mu per equivalent strain,
  // under equal stresses in plane stress E / (2 (1 - nu)). A bar with one band must not soften
  // faster than it unloads.
  const double e = material.youngs_modulus, nu = material.poissons_ratio;
  const double equal = model.problem == Problem::plane_stress ? e / (2.0 * (1.0 - nu)) : e;
  const double least = curve.ultimate / std::min({1.5 * e / (1.0 + nu), equal, e});
  const double softening = curve.failure_strain - curve.ultimate_strain;
  if (softening > least) return;
  throw std::invalid_argument(fmt::format(
      "the spacing {} is too large for the softening of flow: a band would release more energy "
      "than it dissipates; take less than {}",
      model.lattice.spacing, model.lattice.spacing * softening / least));
}

/// Returns the largest sum of p of two neighbours, with the stiffness of own bond k along its
/// direction.
double largest_pair(const ExplicitModel& model, const std::vector<double>& stiffness) {
  const LatticeRows& lattice = model.lattice;
  const int own = lattice.own_bonds();
  std::vector<Eigen::Matrix3d> block(lattice.slots, Eigen::Matrix3d::Zero());
  const auto each_bond = [&](const auto& visit) {
    for (std::size_t r = 0; r < lattice.rows.size(); ++r) {
      for (int k = 0; k < own; ++k) {
        for (Index i = 0; i < lattice.rows[r].size; ++i) {
          const Index slot = lattice.rows[r].first + i;
          if (lattice.present[lattice.at(k, slot)] == 0.0) continue;
          visit(k, slot, slot + lattice.shift_out[r * own + k]);
        }
      }
    }
  };
  each_bond([&](int k, Index a, Index b) {
    const Eigen::Map<const Eigen::Vector3d> n(lattice.bonds[k].direction.data());
    const Eigen::Matrix3d part = stiffness[k] * n * n.transpose();
    block[a] += part;
    block[b] += part;
  });
  std::vector<double> p(lattice.slots, 0.0);
  for (const Index slot : lattice.particle_slot) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block[slot],
                                                                Eigen::EigenvaluesOnly);
    p[slot] = solver.eigenvalues()[2] * model.inverse_mass[slot];
  }
  double largest = 0.0;
  each_bond([&](int, Index a, Index b) { largest = std::max(largest, p[a] + p[b]); });
  return largest;
}

}  // namespace

double mass_damping_rate(double ratio, double period) {
  return 2.0 * ratio * 2.0 * std::numbers::pi / period;
}

ExplicitModel make_explicit_model(Problem problem, LatticeRules rules, LatticeRows lattice,
                                  const LatticeMaterial& material, double thickness) {
  if (dimension_of(problem) != lattice.dim) {
    throw std::invalid_argument("lattice and problem have different dimensions");
  }
  ExplicitModel model;
  model.problem = problem;
  model.rules = rules;
  model.lattice = std::move(lattice);
  model.material = material;
  model.thickness = thickness;
  model.moduli = problem == Problem::three_dimensional
                     ? face_centred_moduli(material.youngs_modulus, material.poissons_ratio,
                                           model.lattice.spacing)
                     : hexagonal_moduli(problem, material.youngs_modulus, material.poissons_ratio,
                                        model.lattice.spacing, thickness);
  model.prescribed.resize(model.lattice.rows.size());
  check_damage(model);
  set_softening(model);
  set_masses(model);
  set_damping(model);
  return model;
}

void prescribe(ExplicitModel& model, const std::vector<PrescribedMotion>& motions) {
  const auto& rows = model.lattice.rows;
  double largest = 0.0;
  for (const PrescribedMotion& motion : motions) {
    if (std::abs(motion.amplitude) > largest) {
      largest = std::abs(motion.amplitude);
      model.load_component = motion.component;
    }
    const auto after =
        std::upper_bound(rows.begin(), rows.end(), motion.slot,
                         [](Index slot, const LatticeRow& row) { return slot < row.first; });
    model.prescribed[after - rows.begin() - 1].push_back(motion);
  }
  for (auto& row : model.prescribed) {
    std::stable_sort(row.begin(), row.end(),
                     [](const auto& a, const auto& b) { return a.slot < b.slot; });
  }
}

double band_width(const ExplicitModel& model, const Vector3& normal) {
  const LatticeRows& lattice = model.lattice;
  const auto cosine = [&](const Vector3& a) {
    const double size = std::hypot(a[0], a[1], a[2]);
    return std::abs(a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]) / size;
  };
  double along = 0.0;  // cosine between the crack and the nearest rows or densest planes
  if (lattice.dim == 2) {
    for (const OwnBond& bond : lattice.bonds) {
      along = std::max(along, cosine({-bond.direction[1], bond.direction[0], 0.0}));
    }
    return lattice.cell_volume / (model.thickness * lattice.spacing * along);
  }
  // Second neighbours lie along the edges of the cube, the densest planes across its diagonals.
  std::vector<Vector3> edge;
  for (const OwnBond& bond : lattice.bonds) {
    if (bond.length > 1.2 * lattice.spacing) edge.push_back(bond.direction);
  }
  for (const double second : {-1.0, 1.0}) {
    for (const double third : {-1.0, 1.0}) {
      Vector3 diagonal{};
      for (int c = 0; c < 3; ++c) {
        diagonal[c] = edge[0][c] + second * edge[1][c] + third * edge[2][c];
      }
      along = std::max(along, cosine(diagonal));
    }
  }
  const double area = 0.5 * std::numbers::sqrt3 * lattice.spacing * lattice.spacing;
  return lattice.cell_volume / (area * along);
}

double frequency_bound_squared(const ExplicitModel& model) {
  double reach = 0.0;
  for (const OwnBond& bond : model.lattice.bonds) reach += 2.0 * bond.length;
  const double stiffening = std::max(0.0, model.moduli.sum) * reach / model.lattice.spacing;
  std::vector<double> stiffness;
  for (int k = 0; k < model.lattice.own_bonds(); ++k) {
    stiffness.push_back((model.own_modulus(k) + stiffening) / model.lattice.bonds[k].length);
  }
  return largest_pair(model, stiffness);
}

double critical_time_step(const ExplicitModel& model) {
  const double elastic = frequency_bound_squared(model);
  const std::vector<double> dampers(model.lattice.bonds.size(), model.bond_damping);
  const double damping = largest_pair(model, dampers) + model.mass_damping;
  // Root of elastic dt^2 + 2 damping dt = 4, in the form without cancellation.
  return 4.0 / (damping + std::sqrt(damping * damping + 4.0 * elastic));
}

}  // namespace perilink
