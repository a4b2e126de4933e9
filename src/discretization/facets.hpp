#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Pieces of the surface of a body and of the faces between its materials: edges in two dimensions,
/// triangles or rectangles in three. Every corner takes a share of the area vector, the integral of
/// its shape function times the normal; so the facets carry tractions to particles and say which
/// forces a uniform strain needs at the boundary (bond calibration).
struct Facets {
  int dim = 2;
  Csr corners;  ///< particles at the corners of each facet
  /// Per corner, as corners.values; their sum is one per facet. Equal, until balance_shares()
  /// shifts them a little.
  std::vector<double> shares;
  /// Area times unit normal, shape (size, dim) [length^2]; in two dimensions the area is length
  /// times thickness.
  std::vector<double> area_vectors;
  std::vector<Index> inside;   ///< material of the cell that the normal points out of
  std::vector<Index> outside;  ///< material of the cell beyond; no_index: the surface of the body

  /// Nonzero where an ordinary finite element holds the other side: its nodes take equal shares,
  /// and so must these; empty: nowhere.
  std::vector<std::uint8_t> tied = {};

  Index size() const { return static_cast<Index>(inside.size()); }
  bool is_tied(Index facet) const { return !tied.empty() && tied[facet] != 0; }
  bool on_surface(Index facet) const { return outside[facet] == no_index; }
  std::span<const double> area_vector(Index facet) const {
    return {area_vectors.data() + static_cast<std::size_t>(facet) * dim,
            static_cast<std::size_t>(dim)};
  }
  /// Mean of the corners' positions [length]; `positions` has shape (particles, dim).
  Vector3 centre(Index facet, std::span<const double> positions) const;
  void append(std::span<const Index> corner_particles, const Vector3& area_vector,
              Index material_inside, Index material_outside);
};

/// Surface and material interfaces of a mesh, in the order of their corners. At an interface the
/// inside is the material of the lower number.
/// \param positions  shape (particles, dim) [length]
/// \param thickness  two-dimensional bodies only [length]
/// \throws std::invalid_argument where more than two cells share a facet
Facets facets_of(const Simplices& cells, std::span<const double> positions, double thickness);

}  // namespace perilink
