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
  /// The first points lie on the faces of cracks. They also move along their normals by the product
  /// of these vectors with the motions of their particles; shape (particles of these points, dim).
  std::vector<double> strain_weights;
  std::vector<double> normals;  ///< of these points; shape (points on faces, dim)

  Index size() const { return particles.rows(); }
  std::span<const double> weights_of(Index embedded_point) const {
    const auto begin = static_cast<std::size_t>(particles.offsets[embedded_point]);
    return {weights.data() + begin, particles.row(embedded_point).size()};
  }
  /// Returns the normal of a point on a face; empty elsewhere.
  std::span<const double> normal_of(Index embedded_point, int dim) const {
    const auto begin = static_cast<std::size_t>(embedded_point) * dim;
    if (begin >= normals.size()) return {};
    return {normals.data() + begin, static_cast<std::size_t>(dim)};
  }
  std::span<const double> strain_weights_of(Index embedded_point, int dim) const {
    const auto begin = static_cast<std::size_t>(particles.offsets[embedded_point]) * dim;
    return {strain_weights.data() + begin, particles.row(embedded_point).size() * dim};
  }
  /// Calls visit(particle, its component, weight) for all that moves a component of a point.
  template <class Visit>
  void for_each_weight(Index embedded_point, int component, int dim, Visit visit) const {
    const auto row = particles.row(embedded_point);
    const auto own = weights_of(embedded_point);
    const auto normal = normal_of(embedded_point, dim);
    if (normal.empty()) {
      for (std::size_t k = 0; k < row.size(); ++k) visit(row[k], component, own[k]);
      return;
    }
    const auto strain = strain_weights_of(embedded_point, dim);
    for (std::size_t k = 0; k < row.size(); ++k) {
      for (int b = 0; b < dim; ++b) {
        visit(row[k], b, (b == component ? own[k] : 0.0) + normal[component] * strain[k * dim + b]);
      }
    }
  }
  void append(std::span<const Index> own_particles, std::span<const double> own_weights) {
    particles.values.insert(particles.values.end(), own_particles.begin(), own_particles.end());
    particles.offsets.push_back(static_cast<Index>(particles.values.size()));
    weights.insert(weights.end(), own_weights.begin(), own_weights.end());
  }
  /// Appends a point on a face; no other point may come before it.
  void append(std::span<const Index> own_particles, std::span<const double> own_weights,
              std::span<const double> own_strain_weights, std::span<const double> normal) {
    append(own_particles, own_weights);
    strain_weights.insert(strain_weights.end(), own_strain_weights.begin(),
                          own_strain_weights.end());
    normals.insert(normals.end(), normal.begin(), normal.end());
  }
};

/// Largest distance between a point and the particles that move it [spacings].
inline constexpr double embedded_point_reach = 2.5;

/// Weights of moving least squares, which reproduce the values of every linear field at a point.
/// They change smoothly with the point. Distant particles have zero weight; the radius grows where
/// particles are few.
/// \param arms     from the point to each particle, shape (n, dim) [length]
/// \param spacing  approximate distance of neighbouring particles [length]
/// \param derivative  0: weights of the value; k: of the derivative along axis k - 1 [1/length]
/// \return per particle; empty if the particles within embedded_point_reach do not span a linear
///     field
std::vector<double> linear_weights(std::span<const double> arms, int dim, double spacing,
                                   int derivative = 0);

}  // namespace perilink
