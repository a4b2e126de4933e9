#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "discretization/hosts/hosts.hpp"

namespace perilink {
namespace {

/// Two triangles that make a square of side 8, or five tetrahedra that make a cube.
Mesh make_mesh(int dim) {
  Mesh mesh;
  mesh.dim = dim;
  if (dim == 2) {
    mesh.positions = {0, 0, 8, 0, 8, 8, 0, 8};
    mesh.cells = {0, 1, 2, 0, 3, 2};  // either way round
  } else {
    mesh.positions = {0, 0, 0, 8, 0, 0, 8, 8, 0, 0, 8, 0, 0, 0, 8, 8, 0, 8, 8, 8, 8, 0, 8, 8};
    mesh.cells = {0, 1, 2, 5, 0, 2, 3, 7, 0, 5, 7, 4, 2, 5, 6, 7, 0, 2, 5, 7};
  }
  return mesh;
}

/// Particles one apart in the square or the cube, its border included.
Particles fill(int dim) {
  Particles particles;
  particles.dim = dim;
  for (int z = 0; z <= (dim == 3 ? 8 : 0); ++z) {
    for (int y = 0; y <= 8; ++y) {
      for (int x = 0; x <= 8; ++x) {
        for (const int c : {x, y}) particles.positions.push_back(c);
        if (dim == 3) particles.positions.push_back(z);
        particles.volumes.push_back(1.0);
        particles.kind.push_back(ParticleKind::solid);
        particles.material.push_back(0);
      }
    }
  }
  return particles;
}

TEST(MeshHosts, ElementsShareTheNodesOfTheirCommonEdges) {
  const Particles particles = fill(2);
  const Hosts linear = hosts_on_mesh(particles, {}, make_mesh(2), 1, 1e-6);
  ASSERT_EQ(linear.size(), 2);
  EXPECT_EQ(linear.num_nodes(), 4);
  EXPECT_EQ(linear.inside.row(0).size(), 45u);
  EXPECT_EQ(linear.inside.row(1).size(), 45u);
  const Hosts quadratic = hosts_on_mesh(particles, {}, make_mesh(2), 2, 1e-6);
  EXPECT_EQ(quadratic.num_nodes(), 9);
  EXPECT_EQ(quadratic.corners_of.row(0).size(), 3u);
  EXPECT_EQ(quadratic.upper, (std::vector<double>{8, 8, 8, 8}));
  const Hosts space = hosts_on_mesh(fill(3), {}, make_mesh(3), 2, 1e-6);
  EXPECT_EQ(space.size(), 5);
  EXPECT_EQ(space.num_nodes(), 8 + 18);  // twelve edges and six diagonals
}

/// Shape functions add up to one and reproduce every polynomial of their order. Tolerance:
/// round-off of numbers below 100.
TEST(MeshHosts, ShapeFunctionsReproducePolynomials) {
  for (const int dim : {2, 3}) {
    const Particles particles = fill(dim);
    for (const int order : {1, 2}) {
      const Hosts hosts = hosts_on_mesh(particles, {}, make_mesh(dim), order, 1e-6);
      const auto polynomial = [&](const double* x) {
        const double last = x[dim - 1];
        return order == 1 ? 1.0 + x[0] - 2.0 * last : 1.0 + x[0] * last - 0.5 * x[1] * x[1];
      };
      for (Index e = 0; e < hosts.size(); ++e) {
        const auto nodes = hosts.nodes_of.row(e);
        const auto inside = hosts.inside.row(e);
        for (std::size_t k = 0; k < inside.size(); ++k) {
          const auto weights = hosts.weights_at(e, k);
          double sum = 0.0;
          for (std::size_t c = 0; c < nodes.size(); ++c) {
            sum += weights[c] * polynomial(hosts.nodes.data() + nodes[c] * dim);
          }
          EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-13);
          EXPECT_NEAR(sum, polynomial(particles.position(inside[k]).data()), 1e-12);
        }
      }
    }
  }
}

TEST(MeshHosts, LeavesOutCellsThatAFaceCuts) {
  const std::vector<double> faces = {6.0, 2.0, 4.0, 4.0};  // inside the first; between the two
  const Hosts hosts = hosts_on_mesh(fill(2), faces, make_mesh(2), 1, 1e-6);
  ASSERT_EQ(hosts.size(), 1);
  EXPECT_EQ(hosts.corners_of.row(0).size(), 3u);
}

TEST(MeshHosts, RefusesCellsThatOverlap) {
  Mesh mesh = make_mesh(2);
  mesh.cells.insert(mesh.cells.end(), {0, 1, 3});
  mesh.cell_tags = {7, 8, 9};
  EXPECT_THROW(hosts_on_mesh(fill(2), {}, mesh, 1, 1e-6), std::invalid_argument);
}

TEST(MeshHosts, RefusesFlatCells) {
  Mesh mesh = make_mesh(2);
  mesh.positions = {0, 0, 8, 0, 4, 0, 0, 8};
  EXPECT_THROW(hosts_on_mesh(fill(2), {}, mesh, 1, 1e-6), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
