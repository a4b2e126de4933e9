#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace perilink {

/// Returns the physical group of the mesh with a name, which build_model() has checked.
const Group& group_named(const Model& model, const std::string& name);

/// Returns solid particles and bar nodes inside a region, ascending. A physical group has its mesh
/// particles and the bar nodes on its points, lines and sides or in its cells. "surface" has the
/// corners of all surface facets and the bar nodes on them; "body" has everything.
/// \param key  place in the case, for messages
/// \throws InputError when there is none
std::vector<Index> particles_of_region(const CaseFile& input, const Model& model,
                                       const std::string& region, const std::string& key);

/// Returns particles in a plane of [[symmetry]], ascending: at its coordinate, or in its region.
/// \param k  entry of [[symmetry]]
/// \throws InputError when its region has none
std::vector<Index> particles_of_plane(const CaseFile& input, const Model& model, std::size_t k);

/// Returns surface facets with centres in a region, or surface facets of a physical group,
/// ascending.
/// \param key  place in the case, for messages
/// \throws InputError when there is none
std::vector<Index> facets_of_region(const CaseFile& input, const Model& model,
                                    const std::string& region, const std::string& key);

/// Solid particle nearest to a point; the first of several at equal distance.
struct NearestParticle {
  Index particle = no_index;
  double distance = 0.0;  ///< [length]
};
NearestParticle nearest_particle(const Particles& particles, std::span<const double> point);

/// Returns the distance [length] of particles around one of them: the mean spacing of the body, or
/// the shortest bond or the longest edge of a finite element there where it is larger.
double spacing_around(const Model& model, Index particle);

}  // namespace perilink
