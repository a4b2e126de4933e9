#include "discretization/facet_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "discretization/mesh_faces.hpp"

namespace perilink {
namespace {

Vector3 along(const Vector3& start, const Vector3& u, double s, const Vector3& v, double t) {
  Vector3 x{};
  for (int axis = 0; axis < 3; ++axis) x[axis] = start[axis] + s * u[axis] + t * v[axis];
  return x;
}

Vector3 nearest_on_segment(const Vector3& a, const Vector3& b, const Vector3& point) {
  const Vector3 edge = minus(b, a);
  const double s = dot(minus(point, a), edge) / dot(edge, edge);
  return along(a, edge, std::clamp(s, 0.0, 1.0), {}, 0.0);
}

}  // namespace

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double norm(const Vector3& a) { return std::sqrt(dot(a, a)); }

Vector3 between(const Vector3& start, const Vector3& end, double fraction) {
  return along(start, minus(end, start), fraction, {}, 0.0);
}

FacetGeometry facet_geometry(const Particles& particles, const Facets& facets, Index facet) {
  const std::span<const Index> ends = facets.corners.row(facet);
  FacetGeometry geometry;
  geometry.edge = ends.size() == 2;
  geometry.a = point_of(particles.positions, particles.dim, ends[0]);
  geometry.b = point_of(particles.positions, particles.dim, ends[1]);
  geometry.c = geometry.edge ? geometry.b : point_of(particles.positions, particles.dim, ends[2]);
  const std::span<const double> area = facets.area_vector(facet);
  std::copy(area.begin(), area.end(), geometry.normal.begin());
  const double length = norm(geometry.normal);
  for (double& component : geometry.normal) component /= length;
  geometry.size =
      std::max({norm(minus(geometry.b, geometry.a)), norm(minus(geometry.c, geometry.b)),
                norm(minus(geometry.a, geometry.c))});
  return geometry;
}

std::vector<FacetGeometry> facet_pieces(const Particles& particles, const Facets& facets,
                                        Index facet) {
  FacetGeometry first = facet_geometry(particles, facets, facet);
  const std::span<const Index> ends = facets.corners.row(facet);
  const bool has_diagonal_only = particles.dim == 3 && ends.size() == 2;
  if (ends.size() < 4 && !has_diagonal_only) return {first};
  FacetGeometry second = first;
  if (has_diagonal_only) {
    const auto normal = std::ranges::max_element(
        first.normal, {}, [](double component) { return std::abs(component); });
    const auto axis = static_cast<std::size_t>(normal - first.normal.begin() + 1) % 3;
    first.edge = second.edge = false;
    first.c = second.c = first.a;
    first.c[axis] = first.b[axis];
    second.c[(axis + 1) % 3] = first.b[(axis + 1) % 3];
    return {first, second};
  }
  second.b = first.c;
  second.c = point_of(particles.positions, particles.dim, ends[3]);
  return {first, second};
}

double height_above(const FacetGeometry& facet, const Vector3& point) {
  return dot(minus(point, facet.a), facet.normal);
}

Vector3 nearest_point(const FacetGeometry& facet, const Vector3& point) {
  if (facet.edge) return nearest_on_segment(facet.a, facet.b, point);
  const Vector3 u = minus(facet.b, facet.a), v = minus(facet.c, facet.a), w = minus(point, facet.a);
  // Barycentric coordinates of the foot of the perpendicular by least squares in u and v.
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double determinant = uu * vv - uv * uv;
  const double s = (wu * vv - wv * uv) / determinant, t = (wv * uu - wu * uv) / determinant;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return along(facet.a, u, s, v, t);
  const Vector3 sides[3] = {nearest_on_segment(facet.a, facet.b, point),
                            nearest_on_segment(facet.b, facet.c, point),
                            nearest_on_segment(facet.c, facet.a, point)};
  return *std::min_element(std::begin(sides), std::end(sides), [&](const auto& p, const auto& q) {
    return norm(minus(p, point)) < norm(minus(q, point));
  });
}

double signed_volume(std::span<const double> positions, int dim, std::span<const Index> cell) {
  const Vector3 a = point_of(positions, dim, cell[0]);
  const Vector3 u = minus(point_of(positions, dim, cell[1]), a);
  const Vector3 v = minus(point_of(positions, dim, cell[2]), a);
  if (dim == 2) return 0.5 * (u[0] * v[1] - u[1] * v[0]);
  return dot(cross(u, v), minus(point_of(positions, dim, cell[3]), a)) / 6.0;
}

}  // namespace perilink
