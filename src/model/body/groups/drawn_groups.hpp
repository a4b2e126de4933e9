#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "discretization/cuts/cracks.hpp"
#include "discretization/lattices/lattice.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Refuses a group with elements that are not sides of cells, because the body has no such facets.
/// \param key  key that names the group, for messages
/// \throws InputError
void refuse_loose_group(const CaseFile& input, const std::string& key, const Body& body,
                        const Group& group);

/// Returns the curves of a group of lines, by their corners.
/// \param key  key that names the group, for messages
/// \throws InputError  where the mesh has no such group, or a line twice
std::vector<std::vector<Vector3>> drawn_curves(const CaseFile& input, const std::string& key,
                                               const std::string& name, const Body& body);

/// Returns the sides of cells of a group of lines (2D) or triangles (3D), with a common positive
/// side. A particle between two materials belongs to the later one, and lies on its side; a
/// particle on the surface lies inside.
/// \param key  key that names the group, for messages
/// \throws InputError  where the body has no such group
std::vector<Crack> drawn_faces(const CaseFile& input, const std::string& key,
                               const std::string& name, const Body& body);

/// Pre-cracks of a case: lines, polygons, and curves or triangles of a mesh.
struct DrawnCracks {
  std::vector<Crack> cracks;
  std::vector<std::size_t> entry;  ///< in [[cracks]], per crack
};

/// Returns the pre-cracks of a case.
/// \throws InputError  for invalid lines, polygons and groups
DrawnCracks drawn_cracks(const CaseFile& input, const Body& body);

/// Returns the key that places a pre-crack, for messages.
std::string place_of_crack(const CaseFile& input, std::size_t entry);

}  // namespace perilink
