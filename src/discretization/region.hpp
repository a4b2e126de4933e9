#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/types.hpp"

namespace perilink {

/// Axis-parallel box [lower, upper]; in two dimensions the third interval is not looked at.
struct Box {
  Vector3 lower{};
  Vector3 upper{};

  /// Whether a point lies in the box or within `tolerance` [length] of it.
  bool contains(std::span<const double> point, double tolerance) const;
};

/// A disc in the plane, a ball in space, or what lies within a radius of a line along an axis.
struct Round {
  Vector3 center{};
  double radius = 0.0;
  std::optional<int> axis;  ///< axis of a cylinder; the center's coordinate along it does not count

  /// Distance of a point from the circle, the sphere or the cylinder's side, negative within.
  double distance(std::span<const double> point) const;
};

/// A named box of the case file, a round part of it, or a physical group of the case's mesh.
struct Region {
  std::string name;
  Box box;  ///< around `round`, where the region has one
  std::optional<Round> round;
  std::string group;  ///< group of the mesh; empty: the shape counts

  /// Whether a point lies in the shape or within `tolerance` [length] of it; negative: deeper in
  /// the shape than that. Not for groups.
  bool contains(std::span<const double> point, double tolerance) const;
};

}  // namespace perilink
