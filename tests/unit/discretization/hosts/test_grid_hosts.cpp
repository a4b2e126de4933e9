#include "discretization/hosts/hosts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace perilink {
namespace {

/// Particles one apart, from the origin.
Particles block(int dim, int columns, int rows, int layers = 1) {
  Particles particles;
  particles.dim = dim;
  for (int z = 0; z < layers; ++z) {
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        for (const int c : {x, y, z}) {
          if (static_cast<int>(particles.positions.size()) <
              dim * static_cast<int>(particles.volumes.size() + 1)) {
            particles.positions.push_back(c);
          }
        }
        particles.volumes.push_back(1.0);
        particles.kind.push_back(ParticleKind::solid);
        particles.material.push_back(0);
      }
    }
  }
  return particles;
}

TEST(GridHosts, OneElementPerCellWithItsBorder) {
  const Particles particles = block(2, 9, 5);
  const Hosts hosts = hosts_on_grid(particles, {}, {{{0, 4, 8}, {0, 4}, {}}}, 1, 1e-6);
  ASSERT_EQ(hosts.size(), 2);
  EXPECT_EQ(hosts.num_nodes(), 6);
  EXPECT_EQ(hosts.inside.row(0).size(), 25u);
  EXPECT_EQ(hosts.inside.row(1).size(), 25u);
  EXPECT_EQ(hosts.lower, (std::vector<double>{0, 0, 4, 0}));
  EXPECT_EQ(hosts.upper, (std::vector<double>{4, 4, 8, 4}));
}

/// Shape functions add up to one and carry every polynomial of their order along each axis.
/// Tolerance: round-off of numbers below 100.
void expect_polynomials(const Particles& particles, const Hosts& hosts, int order) {
  for (Index e = 0; e < hosts.size(); ++e) {
    const auto nodes = hosts.nodes_of.row(e);
    const auto inside = hosts.inside.row(e);
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const auto weights = hosts.weights_at(e, k);
      EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-13);
      for (int a = 0; a < particles.dim; ++a) {
        double sum = 0.0;
        for (std::size_t c = 0; c < nodes.size(); ++c) {
          const std::size_t at = static_cast<std::size_t>(nodes[c]) * particles.dim + a;
          sum += weights[c] * std::pow(hosts.nodes[at], order);
        }
        EXPECT_NEAR(sum, std::pow(particles.position(inside[k])[a], order), 1e-12);
      }
    }
  }
}

TEST(GridHosts, ShapeFunctionsReproducePolynomials) {
  const Particles plane = block(2, 9, 7), space = block(3, 5, 4, 7);
  for (const int order : {1, 2}) {
    const Hosts flat = hosts_on_grid(plane, {}, {{{0, 3.5, 8}, {0, 6}, {}}}, order, 1e-6);
    EXPECT_EQ(flat.nodes_of.row(0).size(), order == 1 ? 4u : 9u);
    expect_polynomials(plane, flat, order);
    const Hosts solid = hosts_on_grid(space, {}, {{{0, 4}, {0, 3}, {0, 3, 6}}}, order, 1e-6);
    EXPECT_EQ(solid.nodes_of.row(0).size(), order == 1 ? 8u : 27u);
    expect_polynomials(space, solid, order);
  }
}

TEST(GridHosts, LeavesOutCellsThatAFaceCuts) {
  const Particles particles = block(2, 9, 5);
  const std::vector<double> faces = {1.5, 1.0, 4.0, 0.5};  // inside the first; between the two
  const Hosts hosts = hosts_on_grid(particles, faces, {{{0, 4, 8}, {0, 4}, {}}}, 1, 1e-6);
  ASSERT_EQ(hosts.size(), 1);
  EXPECT_EQ(hosts.lower.front(), 4.0);
}

TEST(GridHosts, LeavesOutCellsWithoutParticlesInside) {
  const Particles particles = block(2, 5, 5);
  EXPECT_EQ(hosts_on_grid(particles, {}, {{{0, 4, 8}, {0, 4}, {}}}, 1, 1e-6).size(), 1);
}

/// Along an axis with one plane there is nothing to divide: lines that carry the particles of a
/// beam.
TEST(GridHosts, AreLinesWhereOneAxisAloneIsDivided) {
  const Particles particles = block(2, 9, 1);
  for (const int order : {1, 2}) {
    const Hosts hosts = hosts_on_grid(particles, {}, {{{0, 4, 8}, {0}, {}}}, order, 1e-6);
    ASSERT_EQ(hosts.size(), 2);
    EXPECT_EQ(hosts.num_nodes(), 2 * order + 1);
    EXPECT_EQ(hosts.corners_of.row(0).size(), 2u);
    EXPECT_EQ(hosts.inside.row(1).size(), 5u);
    EXPECT_EQ(hosts.upper, (std::vector<double>{4, 0, 8, 0}));
    expect_polynomials(particles, hosts, order);
  }
}

}  // namespace
}  // namespace perilink
