#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Forces that are known to vanish in a body in static equilibrium. The traction at a particle of
/// the surface vanishes along its unloaded axes; the stress around an unloaded particle inside
/// balances itself.
struct SurfaceConditions {
  int dim = 2;
  std::vector<Index> particles;  ///< corners of surface facets, ascending
  std::vector<double> normals;   ///< outward unit normals there, shape (size, dim) [-]
  /// Bit a is set where no load, support, prescribed displacement or bar acts along axis a; per
  /// particle of the body.
  std::vector<std::uint8_t> unloaded;

  bool empty() const { return particles.empty(); }
  /// Returns the outward unit normal at a particle of the surface, nothing inside.
  std::span<const double> normal(Index particle) const {
    const auto found = std::lower_bound(particles.begin(), particles.end(), particle);
    if (found == particles.end() || *found != particle) return {};
    const auto at = static_cast<std::size_t>(found - particles.begin());
    return std::span(normals).subspan(at * static_cast<std::size_t>(dim),
                                      static_cast<std::size_t>(dim));
  }
  bool is_unloaded(Index particle, int axis) const { return (unloaded[particle] >> axis & 1) != 0; }
};

}  // namespace perilink
