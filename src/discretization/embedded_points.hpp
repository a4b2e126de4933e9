#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"

namespace perilink {

/// Points that move with particles around them.
struct EmbeddedPoints {
  /// Per anchor: the particles that move it, by a motion that is the sum of `weights` times theirs.
  Csr particles;
  std::vector<double> weights;

  Index size() const { return particles.rows(); }
  std::span<const double> weights_of(Index embedded_point) const {
    const auto begin = static_cast<std::size_t>(particles.offsets[embedded_point]);
    return {weights.data() + begin, particles.row(embedded_point).size()};
  }
  void append(std::span<const Index> own_particles, std::span<const double> own_weights) {
    particles.values.insert(particles.values.end(), own_particles.begin(), own_particles.end());
    particles.offsets.push_back(static_cast<Index>(particles.values.size()));
    weights.insert(weights.end(), own_weights.begin(), own_weights.end());
  }
};

/// Particles around a point within this many spacings may be asked to move it.
inline constexpr double embedded_point_reach = 2.5;

/// Weights with which the values of a linear field at particles give that at a point, the same for
/// all fields: those of moving least squares, which change smoothly as the point moves. They are
/// zero for particles that are far, and the farther the fewer particles are near.
/// \param arms     from the point to each particle, shape (n, dim) [length]
/// \param spacing  between particles, about [length]
/// \return per particle; empty where the particles within anchor_reach do not span a linear field
std::vector<double> linear_weights(std::span<const double> arms, int dim, double spacing);

}  // namespace perilink
