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

/// Finite elements that carry particles: inside one, particles move by the linear or quadratic
/// shape functions of its nodes. Nodes belong to no particle; elements with common nodes deform
/// together, others are joined by the bonds between their particles alone (Gerstle, Sau & Aguilera
/// 2007, section 4).
struct Hosts {
  int dim = 2;
  std::vector<double> nodes;         ///< positions [length], shape (nodes, dim)
  Csr nodes_of;                      ///< nodes that belong to each element
  Csr corners_of;                    ///< those at its corners, around each face in turn
  Csr inside;                        ///< particles in each element, its border included, ascending
  std::vector<double> lower, upper;  ///< ends along the axes [length], shape (elements, dim)
  /// Shape functions of the element's nodes at its particles, in the order of `inside` and, for
  /// each particle, of the element's `nodes_of`.
  std::vector<double> weights;
  std::vector<std::size_t> first_weight;  ///< per element: where its part of `weights` begins

  Index size() const { return nodes_of.rows(); }
  Index num_nodes() const { return static_cast<Index>(nodes.size()) / dim; }
  /// \param place  where the particle stands in inside.row(element)
  std::span<const double> weights_at(Index element, std::size_t place) const {
    const std::size_t count = nodes_of.row(element).size();
    return {weights.data() + first_weight[element] + place * count, count};
  }
};

/// Where an axis is divided into elements, ascending [length]; two planes at least, or one where
/// all particles lie in it.
using Divisions = std::array<std::vector<double>, 3>;

/// Lines, rectangles or boxes between planes along the axes, one wherever particles lie inside. An
/// element with a point of `faces` inside is left out: faces of the body may lie on its border
/// alone.
/// \param faces      points on faces that no element may have inside [length], shape (points, dim)
/// \param order      degree of the polynomials along each axis: 1 or 2
/// \param tolerance  within which a particle lies on the border of an element [length]
Hosts hosts_on_grid(const Particles& particles, std::span<const double> faces,
                    const Divisions& divisions, int order, double tolerance);

/// The triangles or tetrahedra of a mesh, straight ones; order 2 adds a node on each edge. All else
/// as in carriers_on_grid().
/// \throws std::invalid_argument  where a cell is flat, or cells overlap
Hosts hosts_on_mesh(const Particles& particles, std::span<const double> faces, const Mesh& mesh,
                    int order, double tolerance);

}  // namespace perilink
