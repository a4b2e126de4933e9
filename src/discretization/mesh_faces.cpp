#include "discretization/mesh_faces.hpp"
#include "base/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace perilink {
namespace {

using Corners = std::array<Index, 3>;

/// Corners of the faces of a positively oriented cell; normals point outwards.
constexpr std::array<std::array<int, 2>, 3> faces_of_triangle = {{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 3>, 4> faces_of_tetrahedron = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Face of one cell.
struct CellSide {
  Corners key{no_index, no_index, no_index};  // corners, ascending
  bool odd = false;                           // whether sorting was an odd permutation
  Index cell = no_index;
};

/// Sorts the corners. \return true after an odd number of exchanges
bool sort_corners(Corners& corners, int count) {
  bool odd = false;
  for (int i = 1; i < count; ++i) {
    for (int j = i; j > 0 && corners[j - 1] > corners[j]; --j) {
      std::swap(corners[j - 1], corners[j]);
      odd = !odd;
    }
  }
  return odd;
}

Corners face_corners(const Simplices& cells, Index cell, int face) {
  const std::span<const Index> all = cells.cell(cell);
  Corners corners{no_index, no_index, no_index};
  for (int corner = 0; corner < cells.dim; ++corner) {
    corners[corner] =
        all[cells.dim == 2 ? faces_of_triangle[face][corner] : faces_of_tetrahedron[face][corner]];
  }
  return corners;
}

std::vector<CellSide> all_sides(const Simplices& cells) {
  std::vector<CellSide> sides;
  sides.reserve(cells.vertices.size());
  for (Index cell = 0; cell < cells.size(); ++cell) {
    for (int face = 0; face <= cells.dim; ++face) {
      CellSide side;
      side.key = face_corners(cells, cell, face);
      side.odd = sort_corners(side.key, cells.dim);
      side.cell = cell;
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [&cells](const CellSide& a, const CellSide& b) {
    if (a.key != b.key) return a.key < b.key;
    const Index material_a = cells.material[a.cell], material_b = cells.material[b.cell];
    return material_a != material_b ? material_a < material_b : a.cell < b.cell;
  });
  return sides;
}

std::string place_of(const CellSide& side, int dim, std::span<const double> positions) {
  Vector3 centre{};
  for (int corner = 0; corner < dim; ++corner) {
    const Vector3 x = point_of(positions, dim, side.key[corner]);
    for (int axis = 0; axis < dim; ++axis) centre[axis] += x[axis] / dim;
  }
  return fmt::format("({})", joined({centre.data(), static_cast<std::size_t>(dim)}));
}

}  // namespace

Vector3 point_of(std::span<const double> positions, int dim, Index i) {
  Vector3 x{};
  for (int axis = 0; axis < dim; ++axis) {
    x[axis] = positions[static_cast<std::size_t>(i) * dim + axis];
  }
  return x;
}

CellFaces find_faces(const Simplices& cells, std::span<const double> positions) {
  const std::vector<CellSide> sides = all_sides(cells);
  const char* const name = cells.dim == 2 ? "edge" : "triangle";
  CellFaces faces;
  faces.dim = cells.dim;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].key == sides[begin].key) ++end;
    const CellSide& first = sides[begin];
    if (end - begin > 2) {
      throw std::invalid_argument(
          fmt::format("the {} at {} belongs to {} cells, but a body has one on either side of it",
                      name, place_of(first, cells.dim, positions), end - begin));
    }
    const bool inner = end - begin == 2;
    if (inner && first.odd == sides[begin + 1].odd) {
      throw std::invalid_argument(fmt::format(
          "the cells on both sides of the {} at {} overlap: the mesh is folded there, or "
          "holds a cell twice",
          name, place_of(first, cells.dim, positions)));
    }
    faces.corners.insert(faces.corners.end(), first.key.begin(), first.key.begin() + cells.dim);
    faces.cells.push_back({first.cell, inner ? sides[begin + 1].cell : no_index});
  }
  return faces;
}

Index find_face(const CellFaces& faces, std::span<const Index> corners) {
  const auto key_of = [&faces](std::span<const Index> given) {
    Corners key{no_index, no_index, no_index};
    std::copy(given.begin(), given.end(), key.begin());
    sort_corners(key, faces.dim);
    return key;
  };
  const Corners wanted = key_of(corners);
  Index low = 0, high = faces.size();
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (key_of(faces.face(middle)) < wanted) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < faces.size() && key_of(faces.face(low)) == wanted ? low : no_index;
}

}  // namespace perilink
