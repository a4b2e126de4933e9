#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// The curves that the elements of a group of lines join up to, by their corners [length]: points
/// in a straight line are left out, and a closed curve ends where it begins. Where two lines meet
/// the curve goes on; where more do, as bars that cross, those that are straightest go on in each
/// other and others end. The order is that of the lines.
/// \param group  of dimension one
std::vector<std::vector<Vector3>> curves_of(const Mesh& mesh, const MeshGroup& group);

}  // namespace perilink
