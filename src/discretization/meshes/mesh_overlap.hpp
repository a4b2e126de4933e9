#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/types.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Looks for cells that share area or volume by more than round-off: parts meshed apart that lie in
/// one another, a part that winds round into itself, cells written twice with other corners. Parts
/// that touch, and cracks between corners written twice, are no overlap.
///
/// Where the cells lie properly on both sides of all faces, any overlap reaches to a face of the
/// surface from inside: the number of cells over a point changes only there. So the cells at the
/// surface are compared with all others, and those within are not.
/// \param cells      positively oriented
/// \param positions  shape (particles, dim) [length]
/// \param faces      sides of the cells
/// \return the first two cells that overlap, ascending
std::optional<std::array<Index, 2>> find_overlap(const Simplices& cells,
                                                 std::span<const double> positions,
                                                 const CellFaces& faces);

/// The same of a mesh, whichever way round its cells run.
std::optional<std::array<Index, 2>> find_overlap(const Mesh& mesh);

}  // namespace perilink
