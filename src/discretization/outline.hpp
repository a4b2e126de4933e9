#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/region.hpp"

namespace perilink {

/// Union of axis-parallel boxes on the grid of all their faces (coordinate compression).
struct Outline {
  int dim = 2;
  Box bounds;                               ///< box around the union
  std::array<std::vector<double>, 3> cuts;  ///< coordinates of the grid planes [length]
  std::vector<std::uint8_t> occupied;       ///< cells of the grid, x fastest

  Index cells(int axis) const { return static_cast<Index>(cuts[axis].size()) - 1; }
  bool cell(Index i, Index j, Index k) const {
    if (i < 0 || j < 0 || k < 0 || i >= cells(0) || j >= cells(1) || k >= cells(2)) return false;
    return occupied[i + static_cast<std::size_t>(cells(0)) * (j + cells(1) * k)] != 0;
  }
};

/// \param tolerance  faces closer than this lie in one plane [length]
/// \throws std::invalid_argument without boxes or for a box without extent
Outline make_outline(std::span<const Box> boxes, int dim, double tolerance);

/// Returns the exact volume of the union; in two dimensions its area.
double volume(const Outline& outline);

/// Returns ascending coordinates of the union's faces normal to the axis.
std::vector<double> faces(const Outline& outline, int axis);

}  // namespace perilink
