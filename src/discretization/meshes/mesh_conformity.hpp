#pragma once

#include "discretization/facets.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Refuses a mesh with parts that touch without being joined: a surface vertex lies on a surface
/// facet without being its corner. Such parts were meshed separately or have cells of different
/// size. Forces would not pass correctly between them.
/// \throws std::invalid_argument with the position
void refuse_unjoined_parts(const Particles& particles, const Facets& facets);

/// Name of the group that weld_slits() adds.
inline constexpr const char* slits_of_mesh = "slits of the mesh";

/// Joins the two faces of slits without width, as gmsh's plugin Crack makes them. Such sides of
/// cells coincide and have duplicate corners, in a part that is connected around them. The joined
/// sides become a group. Each side has the cell of one face to its left (2D) or on the side from
/// which its corners run counter-clockwise (3D).
/// \return number of joined sides; 0: the mesh is unchanged
Index weld_slits(Mesh& mesh);

}  // namespace perilink
