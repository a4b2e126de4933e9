#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "discretization/lattices/lattice.hpp"
#include "discretization/meshes/mesh.hpp"

namespace perilink {

/// Returns the material of every cell of a mesh, from the last region that contains the cell, or
/// no_index. A region contains its group's cells, or the cells with their centre in its shape.
/// \param material  per region
std::vector<Index> materials_of_cells(const Mesh& mesh, std::span<const Region> regions,
                                      std::span<const Index> material);

/// Returns a body's tied finite elements, or all its other cells.
Simplices cells_of(const Body& body, bool tied);

/// Makes a body with a particle at every vertex of the cells that have a material.
/// - Volume: integral of the vertex's linear shape function: a third of its triangles times the
///   thickness, or a quarter of its tetrahedra.
/// - Material: at vertices of several materials the highest number.
/// - Facets: of the surface, and of material interfaces with the lower material inside.
/// - Groups: every named one with its particles and surface facets. A group of cells has the facets
///   among its cells' sides.
/// - Lattice: irregular, spacing = mean length of the edges, cell volume = mean volume of a
///   particle.
/// \param material   per cell; cells with no_index are omitted
/// \param thickness  two-dimensional bodies only [length]
/// \param tied       per cell, nonzero for a tied finite element (Body::tied); empty: none
/// \throws std::invalid_argument if no cell has a material, a cell has no volume, cells overlap,
///     or parts touch without being joined
Body make_mesh_body(const Mesh& mesh, std::span<const Index> material, double thickness,
                    std::span<const std::uint8_t> tied = {});

}  // namespace perilink
