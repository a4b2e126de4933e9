#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"

/// \file
/// Where a case loads its body, and the one load and displacement that stand for all places.

namespace perilink {

/// A region, or the particle of a point load, that forces load.
struct LoadRegion {
  std::string name;
  Vector3 force{}, moment{};  ///< resultants at load factor 1 [force], [force length]
  double sizes = 0.0;         ///< sum of the sizes of its forces, at least |force| [force]
};

/// A region that displacements drive.
struct PrescribedRegion {
  std::string name;
  std::vector<std::size_t> slots;       ///< driven components of the motions of its particles
  std::array<bool, 6> drives{};         ///< the components among them
  std::array<double, 6> low{}, high{};  ///< their values at load factor 1 [length], rotations [-]
};

/// The place of a name, a new one where there is none.
template <class Place>
Place& place_named(std::vector<Place>& places, const std::string& name) {
  for (Place& place : places) {
    if (place.name == name) return place;
  }
  places.emplace_back().name = name;
  return places.back();
}

/// What passes through the body: half the sum of the sizes of all forces that balance on it, where
/// places and supports bear one each. Forces F give F against supports or one another, 2 F side by
/// side. A place alone gives its resultant, but no less than half the sum of the sizes of its
/// forces, which is what a pressure all around gives. Without forces the same of moments.
double total_load(std::span<const LoadRegion> places);

/// Largest difference between the driven displacements of two places, or of one and what holds the
/// body still; a vector of the components that both have. Without displacements that of rotations.
/// \param held  components that something holds; those that a single place drives count as held
/// \param dim   components of displacements, rotations come behind
double relative_motion(std::span<const PrescribedRegion> places, const std::array<bool, 6>& held,
                       int dim);

}  // namespace perilink
