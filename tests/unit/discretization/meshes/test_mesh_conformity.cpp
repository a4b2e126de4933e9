#include "discretization/meshes/mesh_conformity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace perilink {
namespace {

/// Three by two squares of two triangles each. The two lines to the right of (0, 1) lie on a slit
/// that is open at its left end: the corners (0, 1) and (1, 1) are written twice.
Mesh slit_mesh() {
  Mesh mesh;
  for (int y = 0; y <= 2; ++y) {
    for (int x = 0; x <= 3; ++x) mesh.positions.insert(mesh.positions.end(), {1.0 * x, 1.0 * y});
  }
  for (Index y = 0; y < 2; ++y) {
    for (Index x = 0; x < 3; ++x) {
      const Index a = 4 * y + x, b = a + 1, c = b + 4, d = a + 4;
      mesh.cells.insert(mesh.cells.end(), {a, b, c, a, d, c});  // the second one runs clockwise
    }
  }
  for (const double x : {0.0, 1.0}) mesh.positions.insert(mesh.positions.end(), {x, 1.0});
  for (std::size_t k = 18; k < mesh.cells.size(); ++k) {  // above
    if (mesh.cells[k] == 4 || mesh.cells[k] == 5) mesh.cells[k] += 8;
  }
  mesh.facets = {12, 13, 13, 6};
  mesh.groups = {{"slit", 1, {0, 1}, {6, 12, 13}}};
  return mesh;
}

TEST(Slits, AreJoinedAndTheirSidesKept) {
  Mesh mesh = slit_mesh();
  ASSERT_EQ(weld_slits(mesh), 2);
  EXPECT_EQ(*std::ranges::max_element(mesh.cells), 11);
  EXPECT_EQ(mesh.groups[0].points, (std::vector<Index>{4, 5, 6}));
  const MeshGroup& slits = mesh.groups[1];
  EXPECT_EQ(slits.name, slits_of_mesh);
  EXPECT_EQ(slits.points, (std::vector<Index>{4, 5, 6}));
  ASSERT_EQ(slits.elements.size(), 2U);
  // The cells below lie to the left of both.
  std::vector<std::pair<Index, Index>> sides;
  for (const Index k : slits.elements)
    sides.push_back({mesh.facets[2 * k], mesh.facets[2 * k + 1]});
  std::ranges::sort(sides);
  EXPECT_EQ(sides, (std::vector<std::pair<Index, Index>>{{5, 4}, {6, 5}}));
  EXPECT_EQ(weld_slits(mesh), 0) << "a second time there is none";
}

/// Parts that touch all along stay apart: nothing else joins them.
TEST(Slits, AreNoTouchingParts) {
  Mesh mesh = slit_mesh();
  for (const double x : {2.0, 3.0}) mesh.positions.insert(mesh.positions.end(), {x, 1.0});
  for (std::size_t k = 18; k < mesh.cells.size(); ++k) {
    if (mesh.cells[k] == 6 || mesh.cells[k] == 7) mesh.cells[k] += 8;
  }
  const std::vector<Index> cells = mesh.cells;
  EXPECT_EQ(weld_slits(mesh), 0);
  EXPECT_EQ(mesh.cells, cells);
  EXPECT_EQ(mesh.groups.size(), 1U);
}

}  // namespace
}  // namespace perilink
