#include "io/mesh/cell_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// Corners of cells of unit edges.
const std::map<CellShape, std::vector<double>> unit_corners = {
    {CellShape::quadrilateral, {0, 0, 1, 0, 1, 1, 0, 1}},
    {CellShape::pyramid, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.4, 0.6, 1}},
    {CellShape::wedge, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}},
    {CellShape::hexahedron,
     {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1}}};
const std::map<CellShape, double> unit_volumes = {{CellShape::quadrilateral, 1.0},
                                                  {CellShape::pyramid, 1.0 / 3.0},
                                                  {CellShape::wedge, 0.5},
                                                  {CellShape::hexahedron, 1.0}};

double volume_of_parts(const std::vector<double>& positions, int dim,
                       const std::vector<Index>& parts) {
  double sum = 0.0;
  for (std::size_t k = 0; k < parts.size(); k += dim + 1) {
    sum += std::abs(signed_volume(positions, dim, std::span(parts).subspan(k, dim + 1)));
  }
  return sum;
}

/// Whatever the ranks, the parts fill the cell, and every face is divided by the diagonal through
/// its corner of lowest rank, which does not depend on the cell.
TEST(CellShapes, PartsFillTheCellAndDivideFacesByTheirLowestCorner) {
  std::mt19937 random(3);
  for (const auto& [shape, positions] : unit_corners) {
    const ShapeProperties& properties = properties_of(shape);
    std::vector<Index> corners(properties.corners);
    std::iota(corners.begin(), corners.end(), 0);
    std::vector<double> rank(corners.begin(), corners.end());
    for (int trial = 0; trial < 100; ++trial) {
      std::shuffle(rank.begin(), rank.end(), random);
      std::vector<Index> parts;
      divide(shape, corners, rank, parts);
      EXPECT_NEAR(volume_of_parts(positions, properties.dim, parts), unit_volumes.at(shape), 1e-15);
      std::set<std::set<Index>> edges;
      const std::size_t width = properties.dim + 1;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        for (std::size_t j = k - k % width; j < k; ++j) edges.insert({parts[j], parts[k]});
      }
      for (const ShapeSide& side : properties.sides) {
        if (side.count != 4) continue;
        const auto lowest = std::min_element(side.corners.begin(), side.corners.end(),
                                             [&](int a, int b) { return rank[a] < rank[b]; });
        const auto at = lowest - side.corners.begin();
        EXPECT_EQ(edges.count({side.corners[at], side.corners[(at + 2) % 4]}), 1u);
        EXPECT_EQ(edges.count({side.corners[(at + 1) % 4], side.corners[(at + 3) % 4]}), 0u);
      }
    }
  }
}

TEST(CellShapes, SidesEncloseTheCell) {
  for (const CellShape shape :
       {CellShape::triangle, CellShape::quadrilateral, CellShape::tetrahedron, CellShape::pyramid,
        CellShape::wedge, CellShape::hexahedron}) {
    const ShapeProperties& properties = properties_of(shape);
    std::map<std::pair<int, int>, int> rims;  // each edge between two sides, once in each direction
    for (const ShapeSide& side : properties.sides) {
      EXPECT_EQ(properties_of(shape_of_side(side.count)).dim, properties.dim - 1);
      if (properties.dim == 2) {
        ++rims[{side.corners[0], 0}];
        ++rims[{side.corners[1], 1}];
        continue;
      }
      for (int k = 0; k < side.count; ++k) {
        ++rims[{side.corners[k], side.corners[(k + 1) % side.count]}];
      }
    }
    for (const auto& [rim, count] : rims) {
      EXPECT_EQ(count, 1);
      if (properties.dim == 3) {
        EXPECT_EQ(rims.count({rim.second, rim.first}), 1u);
      }
    }
  }
}

/// Meshers collapse a face to an edge to make a wedge of a hexahedron.
TEST(CellShapes, CollapsedCellsHaveFewerParts) {
  const std::vector<double>& positions = unit_corners.at(CellShape::wedge);
  const std::vector<double> rank = {3, 0, 5, 1, 4, 2};
  std::vector<Index> parts, triangle_parts;
  divide(CellShape::hexahedron, std::vector<Index>{0, 1, 2, 2, 3, 4, 5, 5}, rank, parts);
  EXPECT_EQ(parts.size(), 3u * 4u);
  EXPECT_NEAR(volume_of_parts(positions, 3, parts), 0.5, 1e-15);
  divide(CellShape::quadrilateral, std::vector<Index>{0, 1, 2, 2}, rank, triangle_parts);
  EXPECT_EQ(triangle_parts.size(), 3u);
}

TEST(CellShapes, SimplicesStay) {
  std::vector<Index> parts;
  divide(CellShape::tetrahedron, std::vector<Index>{7, 3, 9, 1}, {}, parts);
  divide(CellShape::line, std::vector<Index>{5, 2}, {}, parts);
  EXPECT_EQ(parts, (std::vector<Index>{7, 3, 9, 1, 5, 2}));
}

}  // namespace
}  // namespace perilink
