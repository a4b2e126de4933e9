#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/isotropic_weights.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"

namespace perilink::test {

/// Body with initial stiffnesses c V V / xi, scaled so that each particle has about its modulus.
struct Problem {
  Body body;
  Bonds bonds;
  BondStiffness stiffness;
};

inline Problem make_problem(const LatticeInput& input, double ratio, double jitter, bool bending) {
  Problem problem;
  problem.body = make_body(input);
  Particles& particles = problem.body.particles;
  std::vector<std::uint8_t> on_facet(static_cast<std::size_t>(particles.size()), 0);
  for (const Index i : problem.body.facets.corners.values) on_facet[i] = 1;
  std::mt19937 random(7);
  for (Index i = 0; i < particles.size(); ++i) {
    for (int a = 0; a < particles.dim; ++a) {
      const double shift = static_cast<double>(random()) / 4294967296.0 - 0.5;
      if (!on_facet[i])
        particles.positions[i * particles.dim + a] += jitter * input.spacing * shift;
    }
  }
  const double horizon = ratio * problem.body.lattice.spacing;
  problem.bonds = make_bonds(particles, horizon);
  std::vector<double> modulus(static_cast<std::size_t>(particles.size()), 0.0);
  for (Index b = 0; b < problem.bonds.size(); ++b) {
    const Index i = problem.bonds.first[b], j = problem.bonds.second[b];
    const double xi = problem.bonds.lengths[b];
    problem.stiffness.axial.push_back(particles.volumes[i] * particles.volumes[j] / xi *
                                      partial_volume(xi, horizon, input.spacing));
    modulus[i] += 0.5 * problem.stiffness.axial.back() * xi * xi;
    modulus[j] += 0.5 * problem.stiffness.axial.back() * xi * xi;
  }
  const double trace = particles.dim == 2 ? 8.0 : 15.0;
  for (Index b = 0; b < problem.bonds.size(); ++b) {
    double factor = 0.0;
    for (const Index i : {problem.bonds.first[b], problem.bonds.second[b]}) {
      factor += 0.5 * trace * particles.volumes[i] / modulus[i];
    }
    problem.stiffness.axial[b] *= factor;
    if (bending) problem.stiffness.bending.push_back(0.2 * problem.stiffness.axial[b]);
  }
  return problem;
}

inline LatticeInput box(Pattern pattern, double spacing, Vector3 size) {
  LatticeInput input;
  input.pattern = pattern;
  input.spacing = spacing;
  input.surface = Surface::calibrated;
  input.solid = {{{0, 0, 0}, size}};
  input.material = {0};
  return input;
}

}  // namespace perilink::test
