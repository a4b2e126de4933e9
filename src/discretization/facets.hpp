#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/csr.hpp"
#include "base/types.hpp"
#include "discretization/simplices.hpp"

namespace perilink {

/// Pieces of the surface of a body and of its material interfaces: edges in two dimensions,
/// triangles or rectangles in three. Each corner has a nodal area fraction: the integral of its
/// shape function divided by the area. Facets distribute tractions to particles. Bond calibration
/// takes the boundary forces of a uniform strain from them.
struct Facets {
  int dim = 2;
  Csr corners;  ///< particles at the corners of each facet
  /// Nodal area fraction per corner, as corners.values; the sum per facet is one. Fractions are
  /// equal until balance_shares() changes them.
  std::vector<double> shares;
  /// Area times unit normal, shape (size, dim) [length^2]; in two dimensions the area is length
  /// times thickness.
  std::vector<double> area_vectors;
  std::vector<Index> inside;   ///< material of the cell that the normal points out of
  std::vector<Index> outside;  ///< material of the cell beyond; no_index: surface of the body

  /// Nonzero where an ordinary finite element is tied to the facet: its nodes have equal fractions,
  /// so the facet must too. Empty: no tied facets.
  std::vector<std::uint8_t> tied = {};

  Index size() const { return static_cast<Index>(inside.size()); }
  bool is_tied(Index facet) const { return !tied.empty() && tied[facet] != 0; }
  bool on_surface(Index facet) const { return outside[facet] == no_index; }
  std::span<const double> area_vector(Index facet) const {
    return {area_vectors.data() + static_cast<std::size_t>(facet) * dim,
            static_cast<std::size_t>(dim)};
  }
  /// Returns the mean of the corners' positions [length]; `positions` has shape (particles, dim).
  Vector3 centre(Index facet, std::span<const double> positions) const;
  void append(std::span<const Index> corner_particles, const Vector3& area_vector,
              Index material_inside, Index material_outside);
};

/// Returns surface and material interfaces of a mesh, in the order of their corners. At an
/// interface the inside is the material with the lower number.
/// \param positions  shape (particles, dim) [length]
/// \param thickness  two-dimensional bodies only [length]
/// \throws std::invalid_argument if more than two cells share a facet
Facets facets_of(const Simplices& cells, std::span<const double> positions, double thickness);

}  // namespace perilink
