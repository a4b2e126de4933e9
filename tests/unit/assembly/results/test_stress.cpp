#include "assembly/results/stress.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "assembly/fields.hpp"
#include "assembly/results/neighbor_gradients.hpp"
#include "discretization/bonds.hpp"
#include "discretization/lattices/make_body.hpp"
#include "support/small_networks.hpp"

namespace perilink {
namespace {

using test::LatticeCase;
using test::make_network;

/// u_a = sum of gradient_ab x_b + curvature_a x_0 x_last, and its gradient.
constexpr double slope[3][3] = {{0.03, 0.01, -0.02}, {0.02, -0.04, 0.05}, {-0.01, 0.06, 0.07}};
constexpr double curvature[3] = {0.05, -0.03, 0.04};

std::vector<double> quadratic_displacement(const Particles& particles) {
  std::vector<double> displacement;
  for (Index i = 0; i < particles.size(); ++i) {
    const std::span<const double> x = particles.position(i);
    for (int a = 0; a < particles.dim; ++a) {
      double u = curvature[a] * x[0] * x[particles.dim - 1];
      for (int b = 0; b < particles.dim; ++b) u += slope[a][b] * x[b];
      displacement.push_back(u);
    }
  }
  return displacement;
}

Stress exact_stress(const Particles& particles, Problem problem, HookeConstants c, Index i) {
  const int dim = particles.dim;
  const std::span<const double> x = particles.position(i);
  double gradient[3][3] = {};
  for (int a = 0; a < dim; ++a) {
    for (int b = 0; b < dim; ++b) gradient[a][b] = slope[a][b];
    gradient[a][0] += curvature[a] * x[dim - 1];
    gradient[a][dim - 1] += curvature[a] * x[0];
  }
  const double spherical = c.lambda * (gradient[0][0] + gradient[1][1] + gradient[2][2]);
  const auto shear = [&](int a, int b) { return c.mu * (gradient[a][b] + gradient[b][a]); };
  return {spherical + 2.0 * c.mu * gradient[0][0],
          spherical + 2.0 * c.mu * gradient[1][1],
          problem == Problem::plane_stress ? 0.0 : spherical + 2.0 * c.mu * gradient[2][2],
          shear(0, 1),
          shear(1, 2),
          shear(0, 2)};
}

class StressOfQuadraticFields : public testing::TestWithParam<LatticeCase> {};

/// Up to the corners, whose families are a quarter or an eighth.
TEST_P(StressOfQuadraticFields, IsExactEverywhere) {
  const Network network = make_network(GetParam(), 6);
  const Particles& particles = network.particles;
  const Csr neighbourhoods = bonds_of_particles(network.bonds, particles.size());
  const std::vector<double> displacement = quadratic_displacement(particles);
  for (const Problem problem :
       {Problem::plane_stress, Problem::plane_strain, Problem::three_dimensional}) {
    if (dimension_of(problem) != particles.dim) continue;
    const std::vector<HookeConstants> materials = {hooke_constants(problem, 30.0, 0.2)};
    const std::vector<double> stresses =
        particle_stresses({network, neighbourhoods, problem, materials}, displacement);
    for (Index i = 0; i < particles.size(); ++i) {
      const Stress exact = exact_stress(particles, problem, materials[0], i);
      for (std::size_t c = 0; c < 6; ++c) {
        // Round-off of displacements near 0.1 over distances near 0.2, times moduli near 40, and
        // the condition number of the fit, near 1e2.
        EXPECT_NEAR(stresses[6 * i + c], exact[c], 1e-11);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, StressOfQuadraticFields,
    testing::Values(LatticeCase{"rectangular", Pattern::rectangular, Surface::none},
                    LatticeCase{"hexagonal", Pattern::hexagonal, Surface::none},
                    LatticeCase{"cubic", Pattern::cubic, Surface::none},
                    LatticeCase{"face_centred", Pattern::face_centred, Surface::none}),
    [](const auto& tested) { return tested.param.name; });

/// Two rows settle no curvature across, one row no strain across.
TEST(StressAt, FallsBackToWhatTheNeighborsSettle) {
  LatticeInput body = test::body_input({"", Pattern::rectangular, Surface::none}, 6);
  body.solid[0].upper[1] = body.spacing;
  const Network network = build_network(make_body(body), test::network_input(body));
  const Particles& particles = network.particles;
  const Csr neighbourhoods = bonds_of_particles(network.bonds, particles.size());
  const std::vector<HookeConstants> materials = {hooke_constants(Problem::plane_stress, 30.0, 0.2)};
  std::vector<double> displacement;
  for (Index i = 0; i < particles.size(); ++i) {
    const std::span<const double> x = particles.position(i);
    displacement.push_back(0.01 * x[0]);
    displacement.push_back(0.02 * x[1]);
  }
  const StressInput input{network, neighbourhoods, Problem::plane_stress, materials};
  const Stress stress = stress_at(input, displacement, 3);
  EXPECT_NEAR(stress[0], 30.0 / 0.96 * (0.01 + 0.2 * 0.02), 1e-12);
  EXPECT_NEAR(stress[1], 30.0 / 0.96 * (0.02 + 0.2 * 0.01), 1e-12);

  Network row = network;
  row.particles.material.assign(row.particles.material.size(), 0);
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.position(i)[1] > 0.0) row.particles.material[i] = 1;
  }
  const std::vector<HookeConstants> two = {materials[0], materials[0]};
  const Stress none = stress_at({row, neighbourhoods, Problem::plane_stress, two}, displacement, 3);
  EXPECT_EQ(none, Stress{}) << "neighbours of another material do not count";
}

/// Weights are shared within blocks, and these do not depend on the threads.
TEST(ParticleStresses, AreTheSameForAnyNumberOfThreads) {
  const Network network = make_network(test::rectangular, 70);
  ASSERT_GT(network.particles.size(), NeighborGradients<2>::block);
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  const std::vector<double> motion = test::random_vector(network.particles.positions.size(), 5);
  const std::vector<HookeConstants> materials = {hooke_constants(Problem::plane_stress, 30.0, 0.2)};
  const StressInput input{network, neighbourhoods, Problem::plane_stress, materials};
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<double> stresses = particle_stresses(input, motion);
  const std::vector<double> strains = principal_strains(network, neighbourhoods, {}, motion);
  omp_set_num_threads(2);
  EXPECT_EQ(particle_stresses(input, motion), stresses);
  EXPECT_EQ(principal_strains(network, neighbourhoods, {}, motion), strains);
  omp_set_num_threads(before);
}

/// The edges of a cell lead to too few particles for a quadratic field.
TEST(StressAt, SecondNeighborsAreTheNeighborsOfNeighbors) {
  LatticeInput body = test::body_input({"", Pattern::rectangular, Surface::none}, 6);
  body.horizon = 1.01 * body.spacing;
  NetworkInput constants = test::network_input(body);
  constants.micromodulus = Constants::continuum;
  const Network network = build_network(make_body(body), constants);
  const Csr neighbourhoods = bonds_of_particles(network.bonds, network.particles.size());
  const std::vector<double> displacement = quadratic_displacement(network.particles);
  const std::vector<HookeConstants> materials = {hooke_constants(Problem::plane_stress, 30.0, 0.2)};
  const Index middle = 24;
  const Stress exact = exact_stress(network.particles, Problem::plane_stress, materials[0], middle);
  StressInput input{network, neighbourhoods, Problem::plane_stress, materials, true};
  const Stress stress = stress_at(input, displacement, middle);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], exact[c], 1e-11);
}

}  // namespace
}  // namespace perilink
