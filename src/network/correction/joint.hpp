#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/bond_equations.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Materials in layers, which meet in parallel planes. Particles lie in the planes and hold the
/// layers together.
struct Joint {
  int dim = 2;
  Vector3 normal{};            ///< to the planes, of length one
  std::vector<double> planes;  ///< coordinates along the normal, ascending [length]
  std::vector<Index> layers;   ///< materials between them, one more than planes
  double tolerance = 0.0;      ///< this close to a plane a particle lies in it [length]

  double height(std::span<const double> position) const;
  bool in_plane(double height) const;
  /// Number of the layer at a height, the upper one in a plane.
  std::size_t layer_at(double height) const;
};

/// Nothing where materials of different constants meet otherwise, or not at all.
/// \param materials  constants, by Particles::material and Facets
/// \param spacing    between particles [length]
std::optional<Joint> find_joint(const Facets& facets, const Particles& particles,
                                const std::vector<LameConstants>& materials, double spacing);

}  // namespace perilink
