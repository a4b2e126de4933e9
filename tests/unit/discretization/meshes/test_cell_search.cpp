#include "discretization/meshes/cell_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/simplex_meshes.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

/// Two triangles that fill the unit square but for its upper right corner.
Mesh two_triangles() {
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions = {0, 0, 1, 0, 0, 1, 1, 0.5};
  mesh.cells = {0, 1, 2, 1, 2, 3};  // the second one runs the other way round
  return mesh;
}

std::vector<Index> all_cells(const Mesh& mesh) {
  std::vector<Index> cells(static_cast<std::size_t>(mesh.num_cells()));
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

TEST(CellSearch, FindsPointsWhicheverWayCellsRun) {
  const Mesh mesh = two_triangles();
  const CellSearch search(mesh, all_cells(mesh), 0.0);
  EXPECT_TRUE(search.contains({0.25, 0.25, 0.0}));
  EXPECT_TRUE(search.contains({0.9, 0.3, 0.0}));
  EXPECT_FALSE(search.contains({0.9, 0.7, 0.0}));
  EXPECT_FALSE(search.contains({-0.1, 0.5, 0.0}));
  EXPECT_FALSE(search.contains({5.0, 5.0, 0.0}));
}

TEST(CellSearch, LooksAtTheGivenCellsOnly) {
  const Mesh mesh = two_triangles();
  const CellSearch search(mesh, std::array<Index, 1>{1}, 0.0);
  EXPECT_FALSE(search.contains({0.25, 0.25, 0.0}));
  EXPECT_TRUE(search.contains({0.9, 0.3, 0.0}));
  EXPECT_EQ(search.box().lower, (Vector3{0.0, 0.0, 0.0}));
  EXPECT_EQ(search.box().upper, (Vector3{1.0, 1.0, 0.0}));
}

TEST(CellSearch, HoldsPointsWithinTheTolerance) {
  const Mesh mesh = two_triangles();
  const CellSearch search(mesh, all_cells(mesh), 1e-3);
  EXPECT_TRUE(search.contains({0.5, -0.9e-3, 0.0}));
  EXPECT_FALSE(search.contains({0.5, -1.1e-3, 0.0}));
  EXPECT_TRUE(search.contains({0.0, 1.0, 0.0})) << "a corner";
}

/// Meshes of a box fill it and nothing else, wherever the boxes of the grid begin.
TEST(CellSearch, FillsABox) {
  for (const int dim : {2, 3}) {
    Mesh mesh = test::box_mesh(dim, 5);
    for (std::size_t k = 0; k < mesh.positions.size(); k += dim) mesh.positions[k] *= 3.0;
    const CellSearch search(mesh, all_cells(mesh), 1e-12);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-0.3, 1.3);
    int inside = 0;
    for (int n = 0; n < 2000; ++n) {
      Vector3 x{part(random), part(random), dim == 3 ? part(random) : 0.0};
      const bool in_box =
          std::all_of(x.begin(), x.end(), [](double c) { return c >= 0 && c <= 1; });
      x[0] *= 3.0;
      EXPECT_EQ(search.contains(x), in_box) << x[0] << " " << x[1] << " " << x[2];
      inside += in_box ? 1 : 0;
    }
    EXPECT_GT(inside, 300);
  }
}

TEST(CellSearch, RefusesFlatCellsAndNone) {
  Mesh mesh = two_triangles();
  EXPECT_THROW(CellSearch(mesh, {}, 0.0), std::invalid_argument);
  mesh.positions = {0, 0, 1, 0, 0, 1, 0.5, 0.5};  // on the line between the two others
  try {
    CellSearch(mesh, all_cells(mesh), 0.0);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("a corner at (1, 0) is flat: it has no area"));
  }
}

}  // namespace
}  // namespace perilink
