#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"

namespace perilink {

/// Points whose motion is a weighted sum of the motions of nearby particles.
struct EmbeddedPoints {
  /// Per embedded point: particles that move it; `weights` holds one weight per particle.
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

/// Largest distance between a point and the particles that move it [spacings].
inline constexpr double embedded_point_reach = 2.5;

/// Weights of moving least squares, which reproduce the values of every linear field at a point.
/// They change smoothly with the point. Distant particles have zero weight; the radius grows where
/// particles are few.
/// \param arms     from the point to each particle, shape (n, dim) [length]
/// \param spacing  approximate distance of neighbouring particles [length]
/// \return per particle; empty if the particles within embedded_point_reach do not span a linear
///     field
std::vector<double> linear_weights(std::span<const double> arms, int dim, double spacing);

}  // namespace perilink
