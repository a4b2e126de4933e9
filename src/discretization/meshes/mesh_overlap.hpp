#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/types.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Finds two cells that share area or volume beyond round-off. Causes are parts meshed separately
/// that penetrate each other, a part that overlaps itself, and cells written twice with other
/// corners. Touching parts and cracks between duplicate corners are no overlap.
///
/// Only cells at the surface are compared with all others. Where cells lie on both sides of every
/// inner face, the number of cells over a point changes only at the surface. Every overlap
/// therefore reaches a surface face from inside.
/// \param cells      positively oriented
/// \param positions  shape (particles, dim) [length]
/// \param faces      sides of the cells
/// \return first two cells that overlap, ascending; empty if there are none
std::optional<std::array<Index, 2>> find_overlap(const Simplices& cells,
                                                 std::span<const double> positions,
                                                 const CellFaces& faces);

/// Returns the first two cells of a mesh that overlap; cells may have any orientation.
std::optional<std::array<Index, 2>> find_overlap(const Mesh& mesh);

}  // namespace perilink
