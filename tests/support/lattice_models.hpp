#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"

/// \file
/// Small lattice bodies for tests of explicit runs.

namespace perilink::testing_support {

/// Nikravesh & Gerstle 2018, Table 1, in N, m, kg, s.
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

/// The same without damping.
inline LatticeMaterial elastic_concrete(double poissons_ratio = 0.2) {
  LatticeMaterial material = paper_concrete();
  material.poissons_ratio = poissons_ratio;
  material.internal_damping = material.external_damping = 0.0;
  return material;
}

/// Rectangle of the given half sides about the origin.
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

/// Ends of a specimen: those within `depth` of the lowest particle are held in y, those within it
/// of the highest are driven.
inline void grip_ends(ExplicitModel& model, double depth, double amplitude) {
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

}  // namespace perilink::testing_support
