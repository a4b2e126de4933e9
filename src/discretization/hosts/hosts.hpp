#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/meshes/mesh.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Host elements: finite elements that constrain the particles inside them by linear or quadratic
/// shape functions of their nodes. Nodes are not particles. Elements with common nodes deform
/// together; others interact only through their particles' bonds (Gerstle, Sau & Aguilera 2007,
/// section 4).
struct Hosts {
  int dim = 2;
  std::vector<double> nodes;         ///< positions [length], shape (nodes, dim)
  Csr nodes_of;                      ///< nodes of each element
  Csr corners_of;                    ///< corner nodes of each element, around each face in turn
  Csr inside;                        ///< particles in each element, border included, ascending
  std::vector<double> lower, upper;  ///< bounds [length], shape (elements, dim)
  /// Shape functions of the element's nodes at its particles, in the order of `inside`, per
  /// particle in the order of `nodes_of`.
  std::vector<double> weights;
  std::vector<std::size_t> first_weight;  ///< per element, its first index into `weights`

  Index size() const { return nodes_of.rows(); }
  Index num_nodes() const { return static_cast<Index>(nodes.size()) / dim; }
  /// \param place  index of the particle in inside.row(element)
  std::span<const double> weights_at(Index element, std::size_t place) const {
    const std::size_t count = nodes_of.row(element).size();
    return {weights.data() + first_weight[element] + place * count, count};
  }
};

/// Planes between elements along each axis, ascending [length]: at least two, or one that contains
/// all particles.
using Divisions = std::array<std::vector<double>, 3>;

/// Returns host elements with particles inside: lines, rectangles or boxes between planes along the
/// axes. Elements with a point of `faces` inside are omitted; faces may only lie on their borders.
/// \param faces      points on faces of the body [length], shape (points, dim)
/// \param order      degree of the polynomials along each axis: 1 or 2
/// \param tolerance  distance at which a particle lies on the border of an element [length]
Hosts hosts_on_grid(const Particles& particles, std::span<const double> faces,
                    const Divisions& divisions, int order, double tolerance);

/// Returns host elements with particles inside: straight triangles or tetrahedra of a mesh; order 2
/// adds a node on each edge. Elements with a point of `faces` inside are omitted.
/// \param faces      points on faces of the body [length], shape (points, dim)
/// \param order      degree of the polynomials: 1 or 2
/// \param tolerance  distance at which a particle lies on the border of an element [length]
/// \throws std::invalid_argument if a cell is flat or cells overlap
Hosts hosts_on_mesh(const Particles& particles, std::span<const double> faces, const Mesh& mesh,
                    int order, double tolerance);

}  // namespace perilink
