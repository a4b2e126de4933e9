#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"

/// \file
/// Load regions and boundary regions of a case, and the load and displacement of the history.

namespace perilink {

/// A region or particle with forces.
struct LoadRegion {
  std::string name;
  Vector3 force{}, moment{};  ///< resultants at load factor 1 [force], [force length]
  double sizes = 0.0;         ///< sum of force magnitudes, at least |force| [force]
};

/// A region with prescribed displacements.
struct PrescribedRegion {
  std::string name;
  std::vector<std::size_t> slots;       ///< prescribed motion components of its particles
  std::array<bool, 6> drives{};         ///< prescribed components
  std::array<double, 6> low{}, high{};  ///< their values at load factor 1 [length], rotations [-]
};

/// Returns the region with a name, a new one where none has it.
template <class Place>
Place& place_named(std::vector<Place>& places, const std::string& name) {
  for (Place& place : places) {
    if (place.name == name) return place;
  }
  places.emplace_back().name = name;
  return places.back();
}

/// Returns the total load: half the sum of the magnitudes of all balanced forces, of load regions
/// and supports. Forces F give F against supports or each other, and 2 F side by side. A single
/// region gives its resultant, but at least half the sum of its force magnitudes, as for pressure
/// all around. Without forces the total is that of moments.
double total_load(std::span<const LoadRegion> places);

/// Returns the largest difference between the prescribed displacements of two regions, or of a
/// region and the supports, as the norm over their common components. Without displacements it is
/// the largest difference of rotations.
/// \param held  supported components; those prescribed in only one region count as held
/// \param dim   number of displacement components; rotations follow them
double relative_motion(std::span<const PrescribedRegion> places, const std::array<bool, 6>& held,
                       int dim);

}  // namespace perilink
