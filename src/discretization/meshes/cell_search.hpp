#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Tells whether points lie in cells of a mesh. A grid of about as many boxes as cells leads from a
/// point to the few cells near it.
class CellSearch {
 public:
  /// \param cells      numbers of the cells that count, at least one
  /// \param tolerance  points this close to the sides of a cell are inside [length]
  /// \throws std::invalid_argument where there is no cell, or one without area or volume
  CellSearch(const Mesh& mesh, std::span<const Index> cells, double tolerance);

  bool contains(const Vector3& point) const;

  /// Around all cells, with the tolerance.
  const Box& box() const { return box_; }

 private:
  void add_sides(const Mesh& mesh, Index cell);
  void lay_grid(const std::vector<Box>& boxes);
  int step(int axis, double coordinate) const;
  Index bucket(const std::array<int, 3>& steps) const;

  int dim_ = 2;
  double tolerance_ = 0.0;
  Box box_;
  std::vector<double> sides_;  ///< unit normal inwards and offset, shape (cells, dim + 1, dim + 1)
  std::array<int, 3> counts_{1, 1, 1};  ///< boxes of the grid along each axis
  Csr buckets_;                         ///< cells that touch each of them
};

}  // namespace perilink
