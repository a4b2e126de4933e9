#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/bond_equations.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Materials in layers that meet in parallel planes. Particles in the planes join the layers.
struct Joint {
  int dim = 2;
  Vector3 normal{};            ///< unit normal of the planes
  std::vector<double> planes;  ///< coordinates along the normal, ascending [length]
  std::vector<Index> layers;   ///< materials between the planes, one more than planes
  double tolerance = 0.0;      ///< distance at which a particle counts as in a plane [length]

  double height(std::span<const double> position) const;
  bool in_plane(double height) const;
  /// Returns the number of the layer at a height; in a plane the upper layer.
  std::size_t layer_at(double height) const;
};

/// Returns the layers of a body; std::nullopt where materials of different constants meet in other
/// ways, or do not meet.
/// \param materials  constants, by Particles::material and Facets
/// \param spacing    between particles [length]
std::optional<Joint> find_joint(const Facets& facets, const Particles& particles,
                                const std::vector<LameConstants>& materials, double spacing);

}  // namespace perilink
