#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Returns the position of a particle; the third component is zero in two dimensions.
Vector3 point_of(std::span<const double> positions, int dim, Index i);

/// Edges (2D) or triangles (3D) between the cells of a mesh and on its surface, each stored once.
struct CellFaces {
  int dim = 2;
  std::vector<Index> corners;               ///< ascending, shape (size, dim)
  std::vector<std::array<Index, 2>> cells;  ///< on both sides; second is no_index on the surface

  Index size() const { return static_cast<Index>(cells.size()); }
  std::span<const Index> face(Index f) const {
    return {corners.data() + static_cast<std::size_t>(f) * dim, static_cast<std::size_t>(dim)};
  }
};

/// Pairs the faces of positively oriented cells, in the order of their corners. The first cell of a
/// face has the lower material, then the lower number.
/// \param positions  shape (particles, dim), for messages
/// \throws std::invalid_argument if a face belongs to more than two cells or its cells overlap
CellFaces find_faces(const Simplices& cells, std::span<const double> positions);

/// Returns the number of the face with these corners in any order, or no_index.
Index find_face(const CellFaces& faces, std::span<const Index> corners);

}  // namespace perilink
