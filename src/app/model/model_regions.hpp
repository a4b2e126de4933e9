#pragma once

#include <string>
#include <vector>

#include "app/model/model.hpp"

namespace perilink {

/// The physical group of the mesh with a name; build_model() has seen that it exists.
const Group& group_named(const Model& model, const std::string& name);

/// Solid particles and bar nodes inside a region, ascending. A physical group holds the particles
/// of its mesh and the bar nodes on its points, lines, sides or in its cells; "surface" the corners
/// of all facets of the surface and the bar nodes on these; "body" everything.
/// \param key  place in the case, for messages
/// \throws InputError when there is none
std::vector<Index> particles_of_region(const CaseFile& input, const Model& model,
                                       const std::string& region, const std::string& key);

/// Facets of the surface whose centres lie in a region, ascending; of a physical group its facets.
/// \param key  place in the case, for messages
/// \throws InputError when there is none
std::vector<Index> facets_of_region(const CaseFile& input, const Model& model,
                                    const std::string& region, const std::string& key);

/// Solid particle nearest to a point; of several equally near ones the first.
struct NearestParticle {
  Index particle = no_index;
  double distance = 0.0;  ///< [length]
};
NearestParticle nearest_particle(const Particles& particles, std::span<const double> point);

}  // namespace perilink
