#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/types.hpp"

namespace perilink {

/// Axis-parallel box [lower, upper]; in two dimensions the third interval is ignored.
struct Box {
  Vector3 lower{};
  Vector3 upper{};

  /// Returns whether a point lies in the box or within `tolerance` [length] of it.
  bool contains(std::span<const double> point, double tolerance) const;
};

/// Disc in the plane, ball in space, or infinite cylinder along an axis.
struct Round {
  Vector3 center{};
  double radius = 0.0;
  std::optional<int> axis;  ///< cylinder axis; the center's coordinate along it is ignored

  /// Returns the distance of a point from the circle, sphere or cylinder side, negative inside
  /// [length].
  double distance(std::span<const double> point) const;
};

/// Named box of the case file, round part of it, or physical group of the case's mesh.
struct Region {
  std::string name;
  Box box;  ///< bounding box of `round` if there is one
  std::optional<Round> round;
  std::string group;  ///< mesh group; empty: the shape defines the region

  /// Returns whether a point lies in the shape or within `tolerance` [length] of it; a negative
  /// tolerance requires that distance inside the shape. Not valid for groups.
  bool contains(std::span<const double> point, double tolerance) const;
};

}  // namespace perilink
