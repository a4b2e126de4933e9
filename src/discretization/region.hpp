#pragma once

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

/// A named box of the case file, or a physical group of its mesh.
struct Region {
  std::string name;
  Box box;
  std::string group;  ///< of the mesh; empty: the box counts
};

}  // namespace perilink
