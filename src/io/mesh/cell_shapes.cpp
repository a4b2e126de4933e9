#include "io/mesh/cell_shapes.hpp"

#include <algorithm>
#include <tuple>

namespace perilink {
namespace {

using Corners = std::vector<Index>;

/// Returns the place in a list of the point of lowest rank.
std::size_t lowest(const Corners& points, std::span<const double> rank) {
  const auto lower = [&](Index a, Index b) {
    return std::tuple(rank[a], a) < std::tuple(rank[b], b);
  };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), lower) -
                                  points.begin());
}

/// Divides a polygon by diagonals through its point of lowest rank.
/// \param apex  point that makes each triangle a tetrahedron, or no_index
void divide_polygon(const Corners& polygon, std::span<const double> rank, Index apex,
                    Corners& parts) {
  const std::size_t first = lowest(polygon, rank), count = polygon.size();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const Index a = polygon[first], b = polygon[(first + k) % count],
                c = polygon[(first + k + 1) % count];
    if (a == b || b == c || c == a) continue;
    parts.insert(parts.end(), {a, b, c});
    if (apex != no_index) parts.push_back(apex);
  }
}

}  // namespace

const ShapeProperties& properties_of(CellShape shape) {
  static const std::array<ShapeProperties, 8> table = {{
      {"points", 0, 1, {}},
      {"lines", 1, 2, {}},
      {"triangles", 2, 3, {{2, {0, 1}}, {2, {1, 2}}, {2, {2, 0}}}},
      {"quadrilaterals", 2, 4, {{2, {0, 1}}, {2, {1, 2}}, {2, {2, 3}}, {2, {3, 0}}}},
      {"tetrahedra", 3, 4, {{3, {0, 1, 2}}, {3, {0, 3, 1}}, {3, {1, 3, 2}}, {3, {2, 3, 0}}}},
      {"pyramids",
       3,
       5,
       {{4, {0, 1, 2, 3}}, {3, {0, 4, 1}}, {3, {1, 4, 2}}, {3, {2, 4, 3}}, {3, {3, 4, 0}}}},
      {"wedges",
       3,
       6,
       {{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}}},
      {"hexahedra",
       3,
       8,
       {{4, {0, 1, 2, 3}},
        {4, {4, 7, 6, 5}},
        {4, {0, 4, 5, 1}},
        {4, {1, 5, 6, 2}},
        {4, {2, 6, 7, 3}},
        {4, {3, 7, 4, 0}}}},
  }};
  return table[static_cast<std::size_t>(shape)];
}

void divide(CellShape shape, std::span<const Index> corners, std::span<const double> rank,
            std::vector<Index>& parts) {
  const ShapeProperties& properties = properties_of(shape);
  if (properties.corners == properties.dim + 1) {
    parts.insert(parts.end(), corners.begin(), corners.end());
    return;
  }
  const Corners all(corners.begin(), corners.end());
  if (properties.dim == 2) return divide_polygon(all, rank, no_index, parts);
  // Tetrahedra between the lowest corner and the triangles of the faces without this corner.
  const Index apex = all[lowest(all, rank)];
  for (const ShapeSide& side : properties.sides) {
    Corners face;
    for (int k = 0; k < side.count; ++k) face.push_back(all[side.corners[k]]);
    if (std::find(face.begin(), face.end(), apex) == face.end()) {
      divide_polygon(face, rank, apex, parts);
    }
  }
}

}  // namespace perilink
