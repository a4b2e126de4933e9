#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Conforming mesh of linear triangles (2D) or tetrahedra (3D) whose vertices are particles.
struct Simplices {
  int dim = 2;
  std::vector<Index> vertices;  ///< shape (size, dim + 1), positively oriented
  std::vector<Index> material;  ///< per cell

  Index size() const { return static_cast<Index>(material.size()); }
  std::span<const Index> cell(Index number) const {
    const std::size_t width = static_cast<std::size_t>(dim) + 1;
    return {vertices.data() + number * width, width};
  }
};

}  // namespace perilink
