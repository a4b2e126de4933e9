#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Elements of mesh files, by their corners.
enum class CellShape : std::uint8_t {
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  wedge,
  hexahedron
};

/// Side of a cell: numbers of its corners in the cell, two to four.
struct ShapeSide {
  int count = 0;
  std::array<int, 4> corners{};
};

struct ShapeProperties {
  const char* plural;
  int dim;
  int corners;
  std::vector<ShapeSide> sides;  ///< in the order of Abaqus; lines and points have none
};

/// Returns the properties of a shape. Corners are numbered as in the files of gmsh and Abaqus.
const ShapeProperties& properties_of(CellShape shape);

/// Returns the line, triangle or quadrilateral with this number of corners, from two to four.
inline CellShape shape_of_side(int corners) {
  return static_cast<CellShape>(static_cast<int>(CellShape::line) + corners - 2);
}

/// Divides an element into lines, triangles or tetrahedra. Every quadrilateral face is divided by
/// the diagonal through its corner of lowest rank, so that neighbouring cells match. Collapsed
/// cells, which have a corner twice, give fewer parts.
/// \param corners  points at the corners of the element
/// \param rank     per point; needed for shapes other than points, lines, triangles and tetrahedra
/// \param parts    receives the corners of the parts
void divide(CellShape shape, std::span<const Index> corners, std::span<const double> rank,
            std::vector<Index>& parts);

}  // namespace perilink
