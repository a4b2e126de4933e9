#include "discretization/voronoi.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "discretization/meshes/mesh_body.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

Body body_of(const Mesh& mesh) {
  return make_mesh_body(mesh, std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0),
                        1.0);
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Mesh of points on a grid with unit steps, without the squares of which leave_out() is true.
template <class LeaveOut>
Mesh grid_mesh(int columns, int rows, const LeaveOut& leave_out) {
  Mesh mesh;
  mesh.dim = 2;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.positions.insert(mesh.positions.end(), {1.0 * i, 1.0 * j});
    }
  }
  const auto at = [&](int i, int j) { return i + (columns + 1) * j; };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (leave_out(i, j)) continue;
      for (const Index corner :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)}) {
        mesh.cells.push_back(corner);
      }
    }
  }
  return mesh;
}

TEST(Voronoi, CellsOfAGridAreSquaresAndPartsOfThem) {
  // An L of three squares: the corner inside has three quarters of a square.
  const Body body = body_of(grid_mesh(2, 2, [](int i, int j) { return i == 1 && j == 1; }));
  const std::vector<double> volumes = voronoi_volumes(body.particles, body.cells, 0.5);
  for (Index p = 0; p < body.particles.size(); ++p) {
    const auto x = body.particles.position(p);
    int squares = 0;
    for (const double dx : {-0.5, 0.5}) {
      for (const double dy : {-0.5, 0.5}) {
        const double px = x[0] + dx, py = x[1] + dy;
        squares += px > 0.0 && py > 0.0 && px < 2.0 && py < 2.0 && !(px > 1.0 && py > 1.0);
      }
    }
    EXPECT_NEAR(volumes[p], 0.5 * 0.25 * squares, 1e-15) << x[0] << ", " << x[1];
  }
}

TEST(Voronoi, CellsOfFlatTrianglesReachBeyondThem) {
  // Not a third each: the cell of the vertex at the top is half of the triangle.
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions = {0.0, 0.0, 4.0, 0.0, 2.0, 0.1};
  mesh.cells = {0, 1, 2};
  const Body body = body_of(mesh);
  const std::vector<double> volumes = voronoi_volumes(body.particles, body.cells, 1.0);
  // The side to the first vertex meets the base at x = 1 + 0.0025 (|x|^2 = (x - 2)^2 + 0.1^2) and
  // the flank at (1, 0.05).
  const double foot = 4.01 / 4.0;
  const double left = 0.5 * foot * 0.05;
  EXPECT_NEAR(volumes[0], left, 1e-15);
  EXPECT_NEAR(volumes[1], left, 1e-15);
  EXPECT_NEAR(volumes[2], 0.2 - 2.0 * left, 1e-15);
}

class VoronoiOfBoxes : public testing::TestWithParam<int> {};

TEST_P(VoronoiOfBoxes, FillTheBody) {
  const Body body = body_of(test::box_mesh(GetParam(), 5));
  const std::vector<double> volumes = voronoi_volumes(body.particles, body.cells, 1.0);
  EXPECT_NEAR(sum_of(volumes), 1.0, 1e-13);  // some 10^4 pieces
  for (const double volume : volumes) EXPECT_GT(volume, 0.0);
}

TEST_P(VoronoiOfBoxes, HoldThePointsNearestToTheirParticle) {
  const int dim = GetParam(), fine = dim == 2 ? 400 : 80;
  const Body body = body_of(test::box_mesh(dim, 3));
  const Particles& particles = body.particles;
  const std::vector<double> volumes = voronoi_volumes(particles, body.cells, 1.0);
  std::vector<double> counted(volumes.size(), 0.0);
  const double part = std::pow(1.0 / fine, dim);
  for (int n = 0; n < std::lround(1.0 / part); ++n) {
    const double x[3] = {(n % fine + 0.5) / fine, (n / fine % fine + 0.5) / fine,
                         (n / fine / fine + 0.5) / fine};
    Index nearest = 0;
    double least = 1e9;
    for (Index p = 0; p < particles.size(); ++p) {
      double square = 0.0;
      for (int a = 0; a < dim; ++a) square += std::pow(particles.position(p)[a] - x[a], 2);
      if (square >= least) continue;
      least = square;
      nearest = p;
    }
    counted[nearest] += part;
  }
  // Points lie 1 / fine apart, cells are some 1 / 3 wide: their surface times half a step.
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    EXPECT_NEAR(volumes[p], counted[p], 6.0 / 3.0 / fine * std::pow(1.0 / 3.0, dim - 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, VoronoiOfBoxes, testing::Values(2, 3));

}  // namespace
}  // namespace perilink
