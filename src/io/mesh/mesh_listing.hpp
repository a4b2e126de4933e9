#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "discretization/meshes/mesh.hpp"
#include "io/mesh/cell_shapes.hpp"

namespace perilink {

/// Powers of larger numbers leave the range of double precision.
inline constexpr double largest_coordinate = 1e50;

/// Nodes, elements and groups of a mesh file, before the elements are divided.
struct MeshListing {
  struct Group {
    std::string name;
    int dim = 0;
    std::vector<Index> elements;  ///< each once
  };

  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;  ///< [length], shape (nodes, 3)
  std::vector<CellShape> shapes;    ///< per element
  std::vector<std::int64_t> element_tags;
  std::vector<std::int64_t> corners;   ///< tags of the corners of each element in turn
  std::vector<Group> groups;           ///< ascending dimension
  std::array<bool, 4> second_order{};  ///< per dimension, whether elements had more nodes
  std::vector<std::string> notes;

  Index num_elements() const { return static_cast<Index>(shapes.size()); }
};

/// Makes a mesh of the elements of the body's dimension and of the groups' other elements.
/// Quadrilaterals become triangles; hexahedra, wedges and pyramids become tetrahedra. The mesh has
/// notes on divided cells and on cells of second order.
/// \param path  for messages
/// \param dim   2 or 3
/// \throws InputError  where nodes are missing or double, or the cells have another dimension
Mesh make_mesh(MeshListing listing, const std::string& path, int dim);

}  // namespace perilink
