#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Material of every cell of a mesh: of the last region that holds the cell (its group's cells, or
/// the cells whose centre lies in the box); no_index where none does.
/// \param material  per region
std::vector<Index> materials_of_cells(const Mesh& mesh, std::span<const Region> regions,
                                      std::span<const Index> material);

/// The cells of a body that are ordinary finite elements, or all others.
Simplices cells_of(const Body& body, bool tied);

/// Body with a particle at every vertex of the cells that have a material.
/// - Volume: integral of the vertex's linear shape function, a third of the triangles around it
///   times the thickness, a quarter of the tetrahedra.
/// - Material: where several meet the highest number.
/// - Facets: of the surface, and of faces between materials with the lower material inside.
/// - Groups: every named one; its particles, and the facets of the surface among its elements or,
///   of a group of cells, among its cells' sides.
/// - Lattice: irregular, spacing = mean length of the edges, cell volume = mean volume of a
///   particle.
/// \param material   per cell; cells with no_index are left out
/// \param thickness  two-dimensional bodies only [length]
/// \param glued      per cell, nonzero: an ordinary finite element, see Body::glued; empty: none
/// \throws std::invalid_argument where nothing is left, a cell has no volume, cells overlap, parts
///         touch without being joined, or a group's facet is no side of a cell
Body make_mesh_body(const Mesh& mesh, std::span<const Index> material, double thickness,
                    std::span<const std::uint8_t> tied = {});

}  // namespace perilink
