#include "discretization/meshes/scatter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "discretization/facet_geometry.hpp"
#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

/// Parts of the lower and the upper half of a box along x.
std::vector<Index> halves_of(const Mesh& mesh) {
  std::vector<Index> part;
  const int width = mesh.dim + 1;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    double x = 0.0;
    for (int k = 0; k < width; ++k) x += mesh.positions[mesh.cells[cell * width + k] * mesh.dim];
    part.push_back(x / width < 0.5 ? 0 : 1);
  }
  return part;
}

double volume_of(const Mesh& mesh, Index cell) {
  const auto width = static_cast<std::size_t>(mesh.dim) + 1;
  return signed_volume(
      mesh.positions, mesh.dim,
      std::span(mesh.cells).subspan(static_cast<std::size_t>(cell) * width, width));
}

/// A box whose points in the middle plane lie on it, so that it is a face between two parts.
Mesh parted_box(int dim, int count) {
  Mesh mesh = test::box_mesh(dim, count);
  const auto step = static_cast<std::size_t>(dim);
  for (std::size_t k = 0; k < mesh.positions.size(); k += step) {
    double& x = mesh.positions[k];
    if (std::abs(x - 0.5) < 0.2 / count) x = 0.5;
  }
  return mesh;
}

class Scatter : public testing::TestWithParam<int> {};

TEST_P(Scatter, MovesInnerPointsOnly) {
  const int dim = GetParam(), count = 8;
  const double amount = 0.2 / count;
  const Mesh before = parted_box(dim, count);
  Mesh mesh = before;
  scatter_points(mesh, halves_of(mesh), amount, 5);
  int moved = 0, inner = 0;
  for (std::size_t k = 0; k < mesh.positions.size(); k += static_cast<std::size_t>(dim)) {
    bool fixed = before.positions[k] == 0.5;
    double most = 0.0;
    for (int a = 0; a < dim; ++a) {
      const double x = before.positions[k + a];
      fixed = fixed || x == 0.0 || x == 1.0;
      most = std::max(most, std::abs(mesh.positions[k + a] - x));
    }
    EXPECT_LE(most, amount);
    if (fixed) {
      EXPECT_EQ(most, 0.0);
    }
    inner += fixed ? 0 : 1;
    moved += most > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(inner, (count - 2) * static_cast<int>(std::pow(count - 1, dim - 1)));
  EXPECT_GT(moved, inner / 2);
}

TEST_P(Scatter, KeepsTheBodyAndItsCells) {
  const Mesh before = test::box_mesh(GetParam(), 6);
  Mesh mesh = before;
  scatter_points(mesh, std::vector<Index>(static_cast<std::size_t>(mesh.num_cells()), 0), 0.08, 1);
  double sum = 0.0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    EXPECT_GE(volume_of(mesh, cell) / volume_of(before, cell), 0.4);
    sum += std::abs(volume_of(mesh, cell));
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);  // round-off of some thousand cells
}

TEST_P(Scatter, DependsOnTheSeedOnly) {
  const Mesh mesh = test::box_mesh(GetParam(), 4);
  const std::vector<Index> part(static_cast<std::size_t>(mesh.num_cells()), 0);
  Mesh one = mesh, same = mesh, other = mesh;
  scatter_points(one, part, 0.03, 1);
  scatter_points(same, part, 0.03, 1);
  scatter_points(other, part, 0.03, 2);
  EXPECT_EQ(one.positions, same.positions);
  EXPECT_NE(one.positions, other.positions);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Scatter, testing::Values(2, 3));

}  // namespace
}  // namespace perilink
