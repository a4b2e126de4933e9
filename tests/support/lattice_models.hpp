#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

/// \file
/// Small lattice bodies for tests of explicit runs.

namespace perilink::testing_support {

/// Returns the material of Nikravesh & Gerstle 2018, Table 1, in N, m, kg, s.
inline LatticeMaterial paper_concrete() {
  LatticeMaterial material;
  material.youngs_modulus = 25e9;
  material.poissons_ratio = 0.2;
  material.density = 2323.0;
  material.softening = {2.62e6, 0.25, 2e-5, 2e-4};
  material.internal_damping = material.external_damping = 0.2;
  material.fundamental_period = 0.00035;
  return material;
}

/// Returns the material of paper_concrete() without damping and with another Poisson's ratio.
inline LatticeMaterial elastic_concrete(double poissons_ratio = 0.2) {
  LatticeMaterial material = paper_concrete();
  material.poissons_ratio = poissons_ratio;
  material.internal_damping = material.external_damping = 0.0;
  return material;
}

/// Returns a rectangle of given half sides around the origin.
inline LatticeCut rectangle(double half_width, double half_height, double spacing, double degrees,
                            double thickness = 0.15) {
  LatticeCut cut;
  cut.spacing = spacing;
  cut.rotation = degrees * std::numbers::pi / 180.0;
  cut.thickness = thickness;
  cut.lower = {-half_width, -half_height, 0.0};
  cut.upper = {half_width, half_height, 0.0};
  cut.inside = [](const Vector3&) { return true; };
  return cut;
}

inline ExplicitModel plane_model(const LatticeCut& cut, const LatticeMaterial& material,
                                 LatticeRules rules = LatticeRules::consistent,
                                 Problem problem = Problem::plane_stress) {
  return make_explicit_model(problem, rules, hexagonal_rows(cut), material, cut.thickness);
}

/// Clamps the ends of a specimen: fixes particles within `depth` of the lowest one in y, and
/// displaces those within `depth` of the highest.
inline void clamped_ends(ExplicitModel& model, double depth, double amplitude) {
  const LatticeRows& lattice = model.lattice;
  double low = 1e300, high = -1e300;
  for (const Index slot : lattice.particle_slot) {
    const double y = lattice.positions[lattice.at(1, slot)];
    low = std::min(low, y);
    high = std::max(high, y);
  }
  std::vector<PrescribedMotion> motions;
  for (const Index slot : lattice.particle_slot) {
    const double y = lattice.positions[lattice.at(1, slot)];
    if (y <= low + depth) motions.push_back({slot, 1, 0.0});
    if (y >= high - depth) motions.push_back({slot, 1, amplitude});
  }
  prescribe(model, motions);
}

/// Sets velocities without symmetry, so that every mode is excited.
inline void shake_velocities(const ExplicitModel& model, ExplicitState& state) {
  for (const Index slot : model.lattice.particle_slot) {
    state.velocity[slot] = 1e-3 * std::sin(12.9898 * slot);
    state.velocity[model.lattice.at(1, slot)] = 1e-3 * std::cos(7.31 * slot);
  }
}

/// Returns a plate or block with a hole, displaced at one end.
inline ExplicitModel perforated(Problem problem, LatticeRules rules,
                                const LatticeMaterial& material) {
  const bool space = problem == Problem::three_dimensional;
  const double half = space ? 0.1 : 0.5;
  LatticeCut cut = rectangle(half, half, 0.01, 17.0, 1.0);
  cut.lower[2] = -half;
  cut.upper[2] = half;
  cut.inside = [half](const Vector3& x) {
    return std::hypot(x[0] - 0.2 * half, x[1]) > 0.3 * half;
  };
  LatticeRows lattice = space ? face_centred_rows(cut) : hexagonal_rows(cut);
  ExplicitModel model =
      make_explicit_model(problem, rules, std::move(lattice), material, cut.thickness);
  clamped_ends(model, 0.01, 1e-6);
  return model;
}

struct LatticeKind {
  Problem problem;
  LatticeRules rules;
  bool breakable, yields;
};

/// Returns a body in which some particles crack and others flow at once, if the law allows it.
inline ExplicitModel changing_body(const LatticeKind& kind) {
  LatticeMaterial material = paper_concrete();
  material.breakable = kind.breakable;
  material.yields = kind.yields;
  material.softening.strength = 2.62e3;
  material.yielding = {6e3, 9e3, 1e-3, 0.0};
  material.crushing_energy = std::numeric_limits<double>::infinity();
  return perforated(kind.problem, kind.rules, material);
}

/// Returns options of a run of `steps` steps and three rows.
inline ExplicitOptions short_run(const ExplicitModel& model, Index steps) {
  ExplicitOptions options;
  options.time_step = 0.9 * critical_time_step(model);
  options.duration = (steps - 0.5) * options.time_step;
  options.ramp = 0.5 * options.duration;
  options.rows = 3;
  return options;
}

}  // namespace perilink::testing_support
