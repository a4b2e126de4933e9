#include "discretization/meshes/mesh_curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace perilink {
namespace {

using Curves = std::vector<std::vector<Vector3>>;

/// The curves of lines between points whose third coordinate is one.
Curves curves(const std::vector<double>& xy, const std::vector<Index>& lines) {
  std::vector<double> points;
  for (std::size_t k = 0; k < xy.size(); k += 2) {
    points.insert(points.end(), {xy[k], xy[k + 1], 1.0});
  }
  return curves_of(points, lines);
}

std::string refusal(const std::vector<double>& xy, const std::vector<Index>& lines) {
  try {
    curves(xy, lines);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshCurves, JoinLinesInAnyOrderAndLeaveOutStraightPoints) {
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 0, 2, 3}, {2, 1, 2, 3, 1, 0}),
            (Curves{{{0, 0, 1}, {2, 0, 1}, {2, 3, 1}}}))
      << "of three lines the longest runs up";
}

TEST(MeshCurves, RunTheWayOfTheirLines) {
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 1}, {1, 0, 2, 1}), (Curves{{{2, 1, 1}, {1, 0, 1}, {0, 0, 1}}}));
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 1}, {1, 2, 0, 1}), (Curves{{{0, 0, 1}, {1, 0, 1}, {2, 1, 1}}}));
}

TEST(MeshCurves, ClosedOnesEndWhereTheyBegin) {
  EXPECT_EQ(curves({0, 0, 4, 0, 4, 3, 0, 3}, {0, 1, 1, 2, 3, 2, 3, 0}),
            (Curves{{{0, 0, 1}, {4, 0, 1}, {4, 3, 1}, {0, 3, 1}, {0, 0, 1}}}));
}

TEST(MeshCurves, GoStraightOnWhereTheyCross) {
  EXPECT_EQ(curves({0, 1, 1, 1, 2, 1, 1, 0, 1, 2}, {0, 1, 1, 2, 3, 1, 1, 4}),
            (Curves{{{0, 1, 1}, {2, 1, 1}}, {{1, 0, 1}, {1, 2, 1}}}));
}

/// A stirrup whose corners are points of straight bars.
TEST(MeshCurves, TurnWhereOthersGoStraightOn) {
  const std::vector<double> points = {0, 0, -1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  EXPECT_EQ(
      curves_of(points, std::vector<Index>{0, 1, 1, 2, 1, 3, 3, 4, 4, 5, 5, 1}),
      (Curves{{{0, 0, -1}, {0, 0, 1}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}}));
}

TEST(MeshCurves, EndWhereTheyMeetAnotherAtItsSide) {
  EXPECT_EQ(curves({0, 0, 1, 0, 2, 0, 1, 5}, {0, 1, 1, 3, 1, 2}),
            (Curves{{{0, 0, 1}, {2, 0, 1}}, {{1, 0, 1}, {1, 5, 1}}}));
}

TEST(MeshCurves, TurnSharplyWhereTwoLinesMeet) {
  EXPECT_EQ(curves({0, 0, 4, 0, 0, 1}, {0, 1, 1, 2}), (Curves{{{0, 0, 1}, {4, 0, 1}, {0, 1, 1}}}));
}

TEST(MeshCurves, PointsAtOnePlaceAreOne) {
  EXPECT_EQ(curves({0, 0, 1, 0, 1 + 1e-12, 0, 1, 2, 5, 5, 5, 5}, {0, 1, 2, 3, 4, 5}),
            (Curves{{{0, 0, 1}, {1, 0, 1}, {1, 2, 1}}}))
      << "and a line between such points is none";
  EXPECT_TRUE(curves({}, {}).empty());
}

TEST(MeshCurves, RefuseLinesThatAreThereTwice) {
  EXPECT_EQ(refusal({0, 0, 1, 0}, {0, 1, 1, 0}), "has a line twice, one end of it at (1, 0, 1)");
  EXPECT_THAT(refusal({0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 3}), testing::HasSubstr("a line twice"));
}

TEST(MeshCurves, RefuseStars) {
  std::vector<double> points = {0, 0};
  std::vector<Index> lines;
  for (Index k = 1; k <= 101; ++k) {
    points.insert(points.end(), {1.0, 0.01 * k});
    lines.insert(lines.end(), {0, k});
  }
  EXPECT_EQ(refusal(points, lines), "has 101 lines that meet at (0, 0, 1)");
}

}  // namespace
}  // namespace perilink
