#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Physical group: named elements of one dimension.
struct MeshGroup {
  std::string name;
  int dim = 2;                  ///< 0: points, 1: lines, 2: triangles, 3: tetrahedra
  std::vector<Index> elements;  ///< numbers of the group's cells, facets or lines; points have none
  std::vector<Index> points;    ///< corners of the elements, ascending, each once
  bool off_plane = false;       ///< 2D: whether lines leave the plane of the cells
};

/// Linear triangles (2D) or tetrahedra (3D) from a mesh file. Cells may have any orientation, and
/// some points may belong to no cell.
struct Mesh {
  int dim = 2;
  std::vector<double> positions;  ///< [length], shape (points, dim)
  std::vector<Index> cells;       ///< corners, shape (cells, dim + 1)
  std::vector<Index> facets;      ///< edges or triangles of the groups, shape (facets, dim)
  std::vector<Index> lines;       ///< ends of the groups' lines in space, shape (lines, 2)
  std::vector<MeshGroup> groups;
  /// Numbers of the cells in their file; parts of a divided cell share one; empty: 1, 2, 3, ...
  std::vector<std::int64_t> cell_tags;
  std::vector<std::string> notes;  ///< for the user: divided cells, skipped parts of the file

  Index num_points() const { return static_cast<Index>(positions.size()) / dim; }
  Index num_cells() const { return static_cast<Index>(cells.size()) / (dim + 1); }
  /// Returns the number of a cell in its file.
  std::int64_t tag_of(Index cell) const {
    return cell_tags.empty() ? std::int64_t{cell} + 1 : cell_tags[cell];
  }
  Index num_facets() const { return static_cast<Index>(facets.size()) / dim; }
};

}  // namespace perilink
