#pragma once

#include <string>
#include <string_view>

#include "io/mesh/mesh_listing.hpp"

namespace perilink {

/// Reads the nodes, elements and sets of an input file of Abaqus.
/// - Elements: plane stress and strain (CPS, CPE), solids (C3D), as surfaces shells, membranes and
///   rigid faces, as lines trusses and beams. Other types are skipped, axisymmetric ones refused.
/// - Groups: element sets, node sets, and surfaces of elements or nodes.
/// - At most one part, with one instance that is not moved.
/// - Other keywords are skipped, with a note. Keywords that read other files or generate nodes and
///   elements are refused.
/// \param path  for messages
/// \throws InputError  with the line
MeshListing read_abaqus(std::string_view bytes, const std::string& path);

}  // namespace perilink
