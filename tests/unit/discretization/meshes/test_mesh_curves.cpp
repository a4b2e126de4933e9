#include "discretization/meshes/mesh_curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace perilink {
namespace {

using Curves = std::vector<std::vector<Vector3>>;

/// The curves of lines in space between points whose third coordinate is one.
Curves curves(std::vector<double> xy, std::vector<Index> lines) {
  Mesh mesh;
  mesh.dim = 3;
  for (std::size_t k = 0; k < xy.size(); k += 2) {
    mesh.positions.insert(mesh.positions.end(), {xy[k], xy[k + 1], 1.0});
  }
  mesh.lines = std::move(lines);
  MeshGroup group{"bars", 1, std::vector<Index>(mesh.lines.size() / 2), {}};
  std::iota(group.elements.begin(), group.elements.end(), 0);
  return curves_of(mesh, group);
}

TEST(MeshCurves, JoinLinesInAnyOrderAndLeaveOutStraightPoints) {
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 0, 2, 3}, {2, 1, 2, 3, 0, 1}),
            (Curves{{{2, 3, 1}, {2, 0, 1}, {0, 0, 1}}}));
}

TEST(MeshCurves, ClosedOnesEndWhereTheyBegin) {
  EXPECT_EQ(curves({0, 0, 4, 0, 4, 3, 0, 3}, {0, 1, 1, 2, 3, 2, 3, 0}),
            (Curves{{{0, 0, 1}, {4, 0, 1}, {4, 3, 1}, {0, 3, 1}, {0, 0, 1}}}));
}

TEST(MeshCurves, GoStraightOnWhereTheyCross) {
  EXPECT_EQ(curves({0, 1, 1, 1, 2, 1, 1, 0, 1, 2}, {0, 1, 1, 2, 3, 1, 1, 4}),
            (Curves{{{0, 1, 1}, {2, 1, 1}}, {{1, 0, 1}, {1, 2, 1}}}));
}

TEST(MeshCurves, EndWhereTheyMeetAnotherAtItsSide) {
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 0, 1, 5}, {0, 1, 1, 3, 1, 2}),
            (Curves{{{0, 0, 1}, {2, 0, 1}}, {{1, 0, 1}, {1, 5, 1}}}));
}

TEST(MeshCurves, TurnSharplyWhereTwoLinesMeet) {
  EXPECT_EQ(curves({0, 0, 4, 0, 0, 1}, {0, 1, 1, 2}), (Curves{{{0, 0, 1}, {4, 0, 1}, {0, 1, 1}}}));
}

TEST(MeshCurves, InThePlaneTheirLinesAreFacets) {
  Mesh mesh;
  mesh.positions = {0, 0, 1, 0, 3, 0};
  mesh.facets = {0, 1, 1, 2};
  EXPECT_EQ(curves_of(mesh, {"bars", 1, {0, 1}, {}}), (Curves{{{0, 0, 0}, {3, 0, 0}}}));
}

}  // namespace
}  // namespace perilink
