#pragma once

#include "discretization/facets.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Refuses a mesh whose parts only touch: a vertex on the surface that lies on a facet of the
/// surface without being one of its corners (parts meshed apart, or joined by cells of different
/// size). Forces would not pass there as they do inside the body.
/// \throws std::invalid_argument  with the place
void refuse_unjoined_parts(const Particles& particles, const Facets& facets);

/// Name of the group that weld_slits() adds.
inline constexpr const char* slits_of_mesh = "slits of the mesh";

/// Joins the two faces of slits without width, as gmsh's plugin Crack makes them: sides of cells at
/// the same place whose corners are written twice, in a part that hangs together around them. The
/// joined sides become a group, each with the cell of one face to its left (2D) or on the side from
/// which its corners run counter-clockwise.
/// \return number of joined sides; none: nothing was changed
Index weld_slits(Mesh& mesh);

}  // namespace perilink
