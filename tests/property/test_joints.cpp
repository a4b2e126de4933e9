// Bodies of two materials that meet in a plane. Piecewise linear fields with continuous strains
// along the plane and tractions across it are in equilibrium.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "assembly/internal_force.hpp"
#include "support/joint_bodies.hpp"

namespace perilink {
namespace {

using test::height_of_joint;
using test::JointBody;
using test::JointCase;

using Gradient = std::array<Vector3, 3>;

/// Returns displacement gradients below and above, with equal strains along the joint and equal
/// tractions across it.
/// \param field  component of the strain below, axes ascending
std::array<Gradient, 2> gradients(const std::array<LameConstants, 2>& constants, int dim,
                                  std::array<int, 2> field) {
  const int n = dim - 1;
  std::array<Gradient, 2> sides{};
  for (int side = 0; side < 2; ++side) {
    const LameConstants& own = constants[side];
    const LameConstants& below = constants[0];
    const double across = own.lambda + 2.0 * own.mu;
    Gradient& g = sides[side];
    if (field[0] == n) {
      g[n][n] = (below.lambda + 2.0 * below.mu) / across;
    } else if (field[1] == n) {
      g[field[0]][n] = below.mu / own.mu;
    } else {
      g[field[0]][field[1]] = 1.0;
      if (field[0] == field[1]) g[n][n] = (below.lambda - own.lambda) / across;
    }
  }
  return sides;
}

/// Returns the largest difference between bond forces and surface tractions, over the force on a
/// facet.
double largest_rest(const JointBody& joint, std::array<int, 2> field) {
  const Network& network = joint.network;
  const int dim = network.dim();
  const std::array<LameConstants, 2> constants = {
      lame_constants(joint.input, joint.input.materials[0]),
      lame_constants(joint.input, joint.input.materials[1])};
  const std::array<Gradient, 2> sides = gradients(constants, dim, field);
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const auto x = network.particles.position(i);
    const Gradient& g = sides[x[dim - 1] > height_of_joint ? 1 : 0];
    for (int a = 0; a < dim; ++a) {
      double u = g[a][dim - 1] * (x[dim - 1] - height_of_joint);
      for (int b = 0; b + 1 < dim; ++b) u += g[a][b] * x[b];
      motion.push_back(u);
    }
    if (network.carries_moments()) {  // rotation of the layer; zero in the plane
      if (dim == 3) motion.push_back(0.5 * (g[2][1] - g[1][2]));
      if (dim == 3) motion.push_back(0.5 * (g[0][2] - g[2][0]));
      motion.push_back(0.5 * (g[1][0] - g[0][1]));
    }
  }
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  std::vector<double> rest = internal_force(network, intact, motion).forces;
  double size = 0.0;
  for (Index f = 0; f < network.facets.size(); ++f) {
    if (!network.facets.on_surface(f)) continue;
    const Gradient& g = sides[network.facets.inside[f]];
    const LameConstants& own = constants[network.facets.inside[f]];
    const auto area = network.facets.area_vector(f);
    double trace = 0.0;
    for (int a = 0; a < dim; ++a) trace += g[a][a];
    for (int a = 0; a < dim; ++a) {
      double force = own.lambda * trace * area[a];
      for (int b = 0; b < dim; ++b) force += own.mu * (g[a][b] + g[b][a]) * area[b];
      size = std::max(size, std::abs(force));
      for (Index c = network.facets.corners.offsets[f]; c < network.facets.corners.offsets[f + 1];
           ++c) {
        const auto corner = static_cast<std::size_t>(network.facets.corners.values[c]);
        rest[corner * network.width() + a] -= network.facets.shares[c] * force;
      }
    }
  }
  double largest = 0.0;
  for (const double value : rest) largest = std::max(largest, std::abs(value));
  return largest / size;
}

class PiecewiseLinearFields : public testing::TestWithParam<JointCase> {};

TEST_P(PiecewiseLinearFields, AreInEquilibrium) {
  const JointBody joint(GetParam(), GetParam().pattern == Pattern::hexagonal ? 10 : 8);
  EXPECT_LT(joint.network.report.calibration->residual_after, 1e-9);
  for (int a = 0; a < GetParam().dim; ++a) {
    for (int b = a; b < GetParam().dim; ++b) {
      // Round-off of the calibration, which is met to 1e-10.
      EXPECT_LT(largest_rest(joint, {a, b}), 1e-8) << "field " << a << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Joints, PiecewiseLinearFields,
    testing::Values(JointCase{"rectangular", Pattern::rectangular, 2, 8.0, 3.0},
                    JointCase{"rectangular_softer", Pattern::rectangular, 2, 0.1, 3.0},
                    JointCase{"short_horizon", Pattern::rectangular, 2, 10.0, 2.0},
                    JointCase{"hexagonal", Pattern::hexagonal, 2, 8.0, 3.0},
                    JointCase{"mesh", Pattern::irregular, 2, 4.0, 3.0},
                    JointCase{"cubic", Pattern::cubic, 3, 4.0, 3.0},
                    JointCase{"cubic_short_horizon", Pattern::cubic, 3, 0.1, 2.0},
                    JointCase{"hexagonal_short_horizon", Pattern::hexagonal, 2, 10.0, 2.0},
                    JointCase{"moments", Pattern::rectangular, 2, 8.0, 3.0, {{0.2, 0.2}}},
                    JointCase{"moments_unlike", Pattern::rectangular, 2, 0.1, 3.0, {{0.1, 0.3}}},
                    JointCase{"moments_hexagonal", Pattern::hexagonal, 2, 8.0, 2.0, {{0.2, 0.2}}},
                    JointCase{"moments_mesh", Pattern::irregular, 2, 4.0, 3.0, {{0.1, 0.3}}},
                    JointCase{"moments_cubic", Pattern::cubic, 3, 4.0, 2.5, {{0.15, 0.15}}}),
    [](const auto& tested) { return tested.param.name; });

/// Layers may be thinner than the horizon; then no weights balance uniform strains of the whole
/// body.
TEST(Joints, ThreeMaterialsInThinLayersAreInBalance) {
  LatticeInput lattice;
  lattice.surface = Surface::calibrated;
  lattice.spacing = 0.0625;
  lattice.horizon = 3.0 * lattice.spacing;
  lattice.solid = {
      {{0, 0, 0}, {1, 0.5, 1}}, {{0, 0.5, 0}, {1, 0.625, 1}}, {{0, 0.625, 0}, {1, 1, 1}}};
  lattice.material = {0, 1, 2};
  NetworkInput input;
  input.solid = lattice.solid;
  input.horizon = lattice.horizon;
  input.materials = {{3.0}, {30.0}, {0.5}};
  const Network network = build_network(make_body(lattice), input);
  EXPECT_LT(network.report.calibration->residual_after, 1e-9);
  EXPECT_TRUE(find_loose_particles(network).empty());
}

Index bonds_across(const Network& network) {
  const int last = network.dim() - 1;
  Index count = 0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double from = network.particles.position(network.bonds.first[b])[last] - height_of_joint;
    const double to = network.particles.position(network.bonds.second[b])[last] - height_of_joint;
    count += from * to < -1e-12 ? 1 : 0;
  }
  return count;
}

/// Returns the energy of a plane cut parallel to the joint over the energy of a cut inside its
/// layer. Bonds that cross it in the middle count. Their number varies in a mesh, so cuts are
/// compared by energy per force; all cuts have equal forces.
double energy_of_cut(const JointBody& joint, double height) {
  const Network& network = joint.network;
  const int last = network.dim() - 1;
  const auto per_force = [&](double at) {
    double energy = 0.0, force = 0.0;
    for (Index b = 0; b < network.bonds.size(); ++b) {
      const auto x = network.particles.position(network.bonds.first[b]);
      const auto y = network.particles.position(network.bonds.second[b]);
      if ((x[last] - at) * (y[last] - at) >= 0.0) continue;
      if (std::abs(x[0] + y[0] - 1.0) > 0.4) continue;
      const double length = network.bonds.lengths[b];
      const double held = network.stiffness[b] * std::pow(network.critical_stretch[b] * length, 2);
      energy += 0.5 * held;
      force += network.stiffness[b] * std::abs(x[last] - y[last]);
    }
    return energy / force;
  };
  return per_force(height) / per_force(height > height_of_joint ? 0.76 : 0.24);
}

class CutsBesideJoints : public testing::TestWithParam<JointCase> {};

/// Cuts along the joint need the energy of their layer, not a mean, within the 3 % by which rows
/// differ. Without the bonds across the joint and with bonds that the layers share.
TEST_P(CutsBesideJoints, TakeTheEnergyOfTheirLayer) {
  const int count = GetParam().dim == 2 ? 32 : 16;
  JointBody joint(GetParam(), count);
  joint.input.materials[0].fracture_energy = 1.0;
  joint.input.materials[1].fracture_energy = 0.5;
  joint.network = build_network(joint.body, joint.input);
  EXPECT_LT(joint.network.report.calibration->residual_after, 1e-9);
  EXPECT_EQ(bonds_across(joint.network), 0);
  for (const double rows : {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5}) {
    const double height = height_of_joint + 0.9 * rows / count;
    // Single cuts of a mesh differ by a few percent inside a layer too.
    EXPECT_NEAR(energy_of_cut(joint, height), 1.0,
                GetParam().pattern == Pattern::irregular ? 0.08 : 0.035)
        << rows;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Joints, CutsBesideJoints,
    testing::Values(JointCase{"rectangular", Pattern::rectangular, 2, 4.0, 3.0},
                    JointCase{"short_horizon", Pattern::rectangular, 2, 0.1, 2.0},
                    JointCase{"hexagonal", Pattern::hexagonal, 2, 10.0, 3.0},
                    JointCase{"mesh", Pattern::irregular, 2, 4.0, 3.0},
                    JointCase{"cubic", Pattern::cubic, 3, 4.0, 2.0}),
    [](const auto& tested) { return tested.param.name; });

/// Critical stretches of the continuum are independent of layers.
TEST(Joints, KeepTheBondsAcrossWhereTheContinuumBreaksThem) {
  JointBody joint({"rectangular", Pattern::rectangular, 2, 4.0, 3.0}, 8);
  EXPECT_EQ(bonds_across(joint.network), 0);
  joint.input.materials[0].fracture_energy = 1.0;
  joint.input.critical_stretch = Constants::continuum;
  EXPECT_GT(bonds_across(build_network(joint.body, joint.input)), 0);
}

/// The lower part of the lower half can break. Its bonds are a horizon away from the joint and
/// equal those of a body without one.
TEST(Joints, WhatBreaksElsewhereLeavesThemInBalance) {
  for (const Pattern pattern : {Pattern::rectangular, Pattern::irregular}) {
    JointBody joint({"", pattern, 2, 4.0, 2.0}, 16);
    const auto breaks_below = [&](double height) {
      joint.input.materials = {{3.0}, {12.0}, {3.0, 1.0}};
      Particles& particles = joint.body.particles;
      for (Index i = 0; i < particles.size(); ++i) {
        const double y = particles.position(i)[1];
        if (y < height_of_joint) particles.material[i] = y < height ? 2 : 0;
      }
      return build_network(joint.body, joint.input);
    };
    const Network network = breaks_below(0.2);
    EXPECT_EQ(bonds_across(network), 0);
    EXPECT_LT(network.report.calibration->residual_after, 1e-9);
    std::vector<double> stretches;
    for (Index b = 0; b < network.bonds.size(); ++b) {
      if (std::isfinite(network.critical_stretch[b])) {
        stretches.push_back(network.critical_stretch[b]);
      }
    }
    joint.input.materials[1] = {3.0};
    const Network alike = build_network(joint.body, joint.input);
    ASSERT_FALSE(stretches.empty());
    for (const double stretch : stretches) {
      EXPECT_NEAR(stretch,
                  *std::min_element(alike.critical_stretch.begin(), alike.critical_stretch.end()),
                  pattern == Pattern::irregular ? 0.02 * stretch : 1e-12);
    }
  }
}

}  // namespace
}  // namespace perilink
