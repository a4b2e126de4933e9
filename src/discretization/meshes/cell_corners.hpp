#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Corners of a triangle or tetrahedron, with its box and size.
struct CellCorners {
  int count = 0;
  std::array<Vector3, 4> at{};
  Box box;
  double size = 0.0;  ///< longest edge [length]

  /// \param positions  shape (points, dim)
  CellCorners(std::span<const double> positions, int dim, std::span<const Index> points) {
    for (const Index i : points) at[count++] = point_of(positions, dim, i);
    box = {at[0], at[0]};
    for (int k = 1; k < count; ++k) {
      for (int a = 0; a < 3; ++a) {
        box.lower[a] = std::min(box.lower[a], at[k][a]);
        box.upper[a] = std::max(box.upper[a], at[k][a]);
      }
      for (int j = 0; j < k; ++j) size = std::max(size, norm(minus(at[k], at[j])));
    }
  }

  /// Returns the normal of the side opposite to corner k; its length is twice the side's area, in
  /// the plane the side's length.
  Vector3 normal_of_side(int k) const {
    const Vector3& a = at[(k + 1) % count];
    const Vector3 u = minus(at[(k + 2) % count], a);
    return count == 3 ? Vector3{-u[1], u[0], 0.0} : cross(u, minus(at[(k + 3) % count], a));
  }

  /// Least height over the longest edge. Smaller heights are round-off of the coordinates, and so
  /// are areas and volumes over its powers. A regular triangle has 0.4, round-off gives 1e-16.
  static constexpr double flattest = 1e-10;

  [[noreturn]] void refuse_flat() const {
    const int dim = count - 1;
    throw std::invalid_argument(fmt::format("the cell with a corner at ({}) is flat: it has no {}",
                                            joined({at[0].data(), static_cast<std::size_t>(dim)}),
                                            dim == 2 ? "area" : "volume"));
  }
};

}  // namespace perilink
