#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Finds the cells of a mesh that contain a point. A grid with about as many boxes as cells gives
/// the few cells near a point.
class CellSearch {
 public:
  /// \param cells      numbers of the cells to search, at least one
  /// \param tolerance  points this close to the sides of a cell are inside [length]
  /// \throws std::invalid_argument without cells, or for a cell without area or volume
  CellSearch(const Mesh& mesh, std::span<const Index> cells, double tolerance);

  bool contains(const Vector3& point) const;

  /// Calls visit(place) for every cell that contains the point; `place` is an index into `cells`.
  template <class Visit>
  void for_each_around(std::span<const double> point, Visit visit) const {
    if (!box_.contains(point.first(static_cast<std::size_t>(dim_)), 0.0)) return;
    for (const Index cell : near(point)) {
      if (is_inside(cell, point, -tolerance_)) visit(cell);
    }
  }
  /// Returns whether the point is farther than the tolerance from all sides of the cell.
  bool is_within(Index place, std::span<const double> point) const {
    return is_inside(place, point, tolerance_);
  }
  /// Returns the barycentric coordinate [-]: the point's distance from the side opposite to a
  /// corner over the corner's distance from it.
  double height(Index place, int corner, std::span<const double> point) const {
    return distance(place, corner, point) / heights_[index_of_side(place, corner)];
  }

  /// Returns the box around all cells, enlarged by the tolerance.
  const Box& box() const { return box_; }

 private:
  void add_sides(const Mesh& mesh, Index cell);
  void lay_grid(const std::vector<Box>& boxes);
  std::size_t index_of_side(Index place, int side) const {
    return static_cast<std::size_t>(place) * (dim_ + 1) + side;
  }
  double distance(Index place, int side, std::span<const double> point) const;
  bool is_inside(Index place, std::span<const double> point, double margin) const;
  std::span<const Index> near(std::span<const double> point) const;
  int step(int axis, double coordinate) const;
  Index bucket(const std::array<int, 3>& steps) const;

  int dim_ = 2;
  double tolerance_ = 0.0;
  Box box_;
  std::vector<double> sides_;  ///< unit normal inwards and offset, shape (cells, dim + 1, dim + 1)
  std::vector<double> heights_;  ///< heights of corners above their sides, shape (cells, dim + 1)
  std::array<int, 3> counts_{1, 1, 1};  ///< boxes of the grid along each axis
  Csr buckets_;                         ///< cells that touch each box
};

}  // namespace perilink
