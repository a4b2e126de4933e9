#pragma once

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/types.hpp"
#include "discretization/neighbor_search.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Two points at one place have different values.
struct UnlikePoints : std::invalid_argument {
  UnlikePoints(Index one, Index other)
      : std::invalid_argument("points at one place have different values"),
        first(one),
        second(other) {}
  Index first, second;  ///< numbers of the points
};

/// Scalar field in space from values at points, in any order. Where the points are all crossings of
/// lines along the axes (a grid), values are interpolated linearly along each axis, and outside the
/// grid the nearest place of its border counts. Otherwise the value is that of the nearest point.
class PointField {
 public:
  /// \param positions  shape (n, dim), n > 0 [length]
  /// \param values     size n
  /// \throws UnlikePoints
  PointField(std::vector<double> positions, std::vector<double> values, int dim);

  /// \param position  size dim [length]
  double at(std::span<const double> position) const;

  bool is_grid() const { return !nearest_; }
  /// Returns the number of different coordinates along each axis. Points that are no grid have
  /// them only where a grid of these lines has less than twice the points; otherwise they are zero.
  std::array<std::size_t, 3> counts() const;
  const std::vector<double>& values() const { return values_; }  ///< of the different points
  const Box& box() const { return box_; }                        ///< around the points
  /// Returns the distance outside the box up to which the points stand for the field, per axis
  /// [length]: half the outermost step of a grid, infinite with one coordinate; else the mean
  /// distance of points.
  double margin(int axis, bool upper) const;

 private:
  bool lay_grid(std::span<const double> positions);
  double interpolated(std::span<const double> position) const;

  int dim_;
  Box box_;
  std::array<std::vector<double>, 3> lines_;  ///< coordinates along each axis, ascending
  std::vector<double> values_;                ///< shape (z, y, x) of a grid; else per point
  std::optional<NearestPoint> nearest_;       ///< empty: a grid
};

}  // namespace perilink
