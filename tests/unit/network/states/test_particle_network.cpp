#include "network/states/particle_network.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "assembly/internal_force.hpp"
#include "assembly/stiffness.hpp"
#include "discretization/lattices/make_body.hpp"
#include "discretization/lattices/triangulate.hpp"
#include "material/states/state_moduli.hpp"
#include "support/particle_clouds.hpp"

namespace perilink {
namespace {

using test::random_numbers;
using test::unstructured_particles;

class ParticleNetworks : public testing::TestWithParam<int> {
 protected:
  int dim() const { return GetParam(); }
  int count() const { return dim() == 2 ? 7 : 4; }
};

TEST_P(ParticleNetworks, BondNearestNeighbours) {
  const Network network = unstructured_particles(dim(), count()).network;
  const Particles& particles = network.particles;
  std::vector<int> members(static_cast<std::size_t>(particles.size()), 0);
  std::vector<double> farthest(members.size(), 0.0);
  for (Index e = 0; e < network.num_elements(); ++e) {
    EXPECT_TRUE(network.counts_for(e, first_end) || network.counts_for(e, second_end));
    for (const auto& [end, i] : {std::pair{first_end, network.bonds.first[e]},
                                 std::pair{second_end, network.bonds.second[e]}}) {
      if (!network.counts_for(e, end)) continue;
      ++members[i];
      farthest[i] = std::max(farthest[i], network.bonds.lengths[e]);
    }
  }
  const int wanted = dim() == 2 ? neighbors_in_plane : neighbors_in_space;
  for (Index i = 0; i < particles.size(); ++i) {
    std::vector<double> distance;
    for (Index j = 0; j < particles.size(); ++j) {
      double square = 0.0;
      for (int a = 0; a < dim(); ++a) {
        square += std::pow(particles.position(i)[a] - particles.position(j)[a], 2);
      }
      if (j != i) distance.push_back(std::sqrt(square));
    }
    std::sort(distance.begin(), distance.end());
    const double radius = distance[wanted - 1];
    const auto within = std::count_if(distance.begin(), distance.end(),
                                      [&](double d) { return d <= radius * (1.0 + 1e-6); });
    EXPECT_EQ(members[i], within);
    EXPECT_NEAR(farthest[i], radius, 1e-6 * radius);
  }
}

TEST_P(ParticleNetworks, HaveTheMatrixOfTheirForces) {
  const Network network = unstructured_particles(dim(), count()).network;
  const std::size_t slots = network.particles.positions.size();
  const auto secants =
      random_numbers(static_cast<std::size_t>(network.num_elements()), 3, 0.0, 1.0);
  const Unknowns unknowns =
      number_unknowns(dim(), std::vector<std::uint8_t>(slots, 0), std::vector<double>(slots, 0.0));
  const Eigen::MatrixXd matrix = Eigen::MatrixXd(assemble_stiffness(network, secants, unknowns))
                                     .selfadjointView<Eigen::Lower>();
  double worst = 0.0;
  for (std::size_t column = 0; column < slots; ++column) {
    std::vector<double> unit(slots, 0.0);
    unit[column] = 1.0;
    const std::vector<double> forces = internal_force(network, secants, unit).forces;
    for (std::size_t row = 0; row < slots; ++row) {
      worst = std::max(worst, std::abs(matrix(row, column) - forces[row]));
    }
  }
  // Sums of some hundred products in another order.
  EXPECT_LT(worst, 1e-13 * matrix.cwiseAbs().maxCoeff());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(values[0], -1e-12 * values[values.size() - 1]) << "no deformation has negative energy";
}

/// Under a uniform strain a particle stores a quarter of sum_j L_j F_j S_j with the constants of
/// the fit to its own neighbours.
TEST_P(ParticleNetworks, StoreTheEnergyOfTheirFits) {
  const ParticleNetwork built = unstructured_particles(dim(), count());
  const Network& network = built.network;
  const ParticleFitReport& report = built.report;
  EXPECT_EQ(report.exact + report.least + report.many + report.indefinite + report.singular,
            network.particles.size());
  const Vector3 strain{1e-3, -2e-3, 0.5e-3};
  const Csr around = bonds_of_particles(network.bonds, network.particles.size());
  double exact = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    std::vector<NeighbourhoodBond> neighbourhood;
    double farthest = 0.0;
    for (const Index e : around.row(i)) {
      if (!network.counts_for(e, network.bonds.first[e] == i ? first_end : second_end)) continue;
      NeighbourhoodBond bond{{}, network.bonds.lengths[e], false};
      for (int a = 0; a < dim(); ++a) bond.direction[a] = network.bonds.direction(e)[a];
      farthest = std::max(farthest, bond.length);
      neighbourhood.push_back(bond);
    }
    for (NeighbourhoodBond& bond : neighbourhood) bond.far = bond.length > 0.85 * farthest;
    const ParticleFit fit =
        fit_particle_moduli(dim() == 2 ? Problem::plane_stress : Problem::three_dimensional, 30.0,
                            0.2, neighbourhood, network.particles.volumes[i]);
    double sum = 0.0;
    for (const NeighbourhoodBond& bond : neighbourhood) {
      const Vector3& n = bond.direction;
      const double stretch = strain[0] * n[0] * n[0] + strain[1] * n[1] * n[1] +
                             (dim() == 3 ? strain[2] : 0.0) * n[2] * n[2];
      const double own = fit.moduli.own + (bond.far ? fit.moduli.far : 0.0);
      exact += 0.25 * bond.length * own * stretch * stretch;
      sum += bond.length * stretch;
    }
    exact += 0.25 * fit.moduli.state * sum * sum;
  }
  std::vector<double> motion;
  for (Index i = 0; i < network.particles.size(); ++i) {
    for (int a = 0; a < dim(); ++a) motion.push_back(strain[a] * network.particles.position(i)[a]);
  }
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  EXPECT_NEAR(internal_force(network, intact, motion).energy, exact, 1e-12 * exact);
  EXPECT_GT(report.mean_residual, 0.0);
  EXPECT_GE(report.largest_residual, report.mean_residual);
}

TEST_P(ParticleNetworks, FillTheirBody) {
  const Network network = unstructured_particles(dim(), count()).network;
  const auto& volumes = network.particles.volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ParticleNetworks, testing::Values(2, 3));

TEST(ParticleNetworksOfLattices, AreThoseOfHexagonalLatticesInside) {
  LatticeInput input;
  input.pattern = Pattern::hexagonal;
  input.spacing = 0.1;
  input.solid = {{{0.0, 0.0, 0.0}, {1.0, 12 * 0.05 * std::numbers::sqrt3, 0.0}}};
  input.material = {0};
  Body body = make_body(input);
  body.cells = triangulate(input, body);
  const ParticleNetwork built =
      make_particle_network(body, Problem::plane_stress, std::vector{test::soft_solid}, 1.0);
  const StateModuli exact = hexagonal_moduli(Problem::plane_stress, 30.0, 0.2, 0.1, 1.0);
  const auto is_inside = [&](Index i) {
    const auto x = body.particles.position(i);
    return x[0] > 0.16 && x[0] < 0.84 && x[1] > 0.16 && x[1] < 0.87;
  };
  int inside = 0;
  for (Index i = 0; i < body.particles.size(); ++i) {
    if (!is_inside(i)) continue;
    ++inside;
    EXPECT_NEAR(built.network.states->stiffness[i], exact.sum / (2.0 * 0.1), 1e-9 * exact.own);
  }
  EXPECT_GE(built.report.exact, inside);
  for (Index e = 0; e < built.network.num_elements(); ++e) {
    if (!is_inside(built.network.bonds.first[e]) || !is_inside(built.network.bonds.second[e]))
      continue;
    EXPECT_NEAR(built.network.stiffness[e], exact.own / 0.1, 1e-9 * exact.own / 0.1);
  }
}

/// A square with a slot from the right.
TEST(ParticleNetworksOfSlots, SeeNoneBeyondTheSlotButAsManyAsOthers) {
  Mesh mesh;
  mesh.dim = 2;
  const int n = 9;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.positions.insert(mesh.positions.end(), {1.0 * i, j == 5 ? 4.3 : 1.0 * j});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      if (j == 4 && i >= 3) continue;
      const Index a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      for (const Index corner : {a, b, c, a, c, d}) mesh.cells.push_back(corner);
    }
  }
  const Body body = make_mesh_body(mesh, std::vector<Index>(mesh.cells.size() / 3, 0), 1.0);
  const ParticleNetwork built =
      make_particle_network(body, Problem::plane_stress, std::vector{test::soft_solid}, 1.0);
  const Network& network = built.network;
  std::vector<int> members(static_cast<std::size_t>(body.particles.size()), 0);
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto a = body.particles.position(network.bonds.first[e]);
    const auto b = body.particles.position(network.bonds.second[e]);
    const bool across = (a[1] < 4.1) != (b[1] < 4.1);
    EXPECT_FALSE(across && a[0] > 3.5 && b[0] > 3.5) << a[0] << " to " << b[0];
    members[network.bonds.first[e]] += network.counts_for(e, first_end);
    members[network.bonds.second[e]] += network.counts_for(e, second_end);
  }
  EXPECT_GE(*std::min_element(members.begin(), members.end()), neighbors_in_plane);
  EXPECT_EQ(built.report.singular, 0);
}

TEST(ParticleNetworksOfFlatGrids, TakeMoreNeighboursThanThoseInOneLine) {
  // Three steps along x are shorter than one along y: the six nearest lie in a row.
  Mesh mesh = test::box_mesh(2, 8);
  for (std::size_t k = 0; k < mesh.positions.size(); k += 2) {
    mesh.positions[k] = std::round(8.0 * mesh.positions[k]) / 32.0;
    mesh.positions[k + 1] = std::round(8.0 * mesh.positions[k + 1]) / 8.0;
  }
  const Body body = make_mesh_body(mesh, std::vector<Index>(mesh.cells.size() / 3, 0), 1.0);
  const ParticleNetwork built =
      make_particle_network(body, Problem::plane_stress, std::vector{test::soft_solid}, 1.0);
  EXPECT_GT(built.report.enlarged, 0);
  EXPECT_EQ(built.report.singular, 0);
}

}  // namespace
}  // namespace perilink
