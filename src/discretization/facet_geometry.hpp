#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Corners of a surface edge (2D) or triangle (3D).
struct FacetGeometry {
  bool edge = true;       ///< true: only the corners a and b are used
  Vector3 a{}, b{}, c{};  ///< [length]
  Vector3 normal{};       ///< unit vector out of the body
  double size = 0.0;      ///< longest side [length]
};

/// \param facet  two corners in the plane, three in space
FacetGeometry facet_geometry(const Particles& particles, const Facets& facets, Index facet);

/// Returns a facet as an edge or as triangles: rectangles are divided along a diagonal. Faces of
/// face-centred lattices are rectangles of which two opposite corners are particles.
std::vector<FacetGeometry> facet_pieces(const Particles& particles, const Facets& facets,
                                        Index facet);

/// Returns the distance along the normal from the facet's line or plane, positive outside [length].
double height_above(const FacetGeometry& facet, const Vector3& point);

/// Returns the point of the facet nearest to `point`.
Vector3 nearest_point(const FacetGeometry& facet, const Vector3& point);

/// Returns the area of a triangle or volume of a tetrahedron, negative for reversed corners.
/// \param positions  shape (points, dim) [length]
double signed_volume(std::span<const double> positions, int dim, std::span<const Index> cell);

double dot(const Vector3& a, const Vector3& b);
Vector3 minus(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
double norm(const Vector3& a);
/// Returns start + fraction * (end - start).
Vector3 between(const Vector3& start, const Vector3& end, double fraction);

}  // namespace perilink
