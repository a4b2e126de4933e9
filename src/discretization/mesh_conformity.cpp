#include "discretization/mesh_conformity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// A vertex this close to a facet lies on it, in sizes of the facet. Meshes are written with 16
/// digits; the distance between a curve and its chord is far larger.
constexpr double touching = 1e-7;

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Corners of a facet; an edge in the plane repeats its last one.
struct Corners {
  Vector3 a, b, c;
  bool edge;
};

double size_of(const Corners& facet) {
  const Vector3 ab = minus(facet.b, facet.a), bc = minus(facet.c, facet.b),
                ca = minus(facet.a, facet.c);
  return std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
}

/// Whether a point lies on the facet, its border included.
bool lies_on(const Corners& facet, const Vector3& x, double tolerance) {
  const Vector3 u = minus(facet.b, facet.a), v = minus(facet.c, facet.a), w = minus(x, facet.a);
  // Barycentric coordinates of the foot of the perpendicular: least squares in u and v.
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  double s = wu / uu, t = 0.0;
  if (!facet.edge) {
    const double determinant = uu * vv - uv * uv;
    s = (wu * vv - wv * uv) / determinant;
    t = (wv * uu - wu * uv) / determinant;
  }
  const double margin = tolerance / size_of(facet);
  if (s < -margin || t < -margin || s + t > 1.0 + margin) return false;
  Vector3 off{};
  for (int axis = 0; axis < 3; ++axis) off[axis] = w[axis] - s * u[axis] - t * v[axis];
  return dot(off, off) <= tolerance * tolerance;
}

Corners corners_of(const Particles& particles, const Facets& facets, Index f) {
  const std::span<const Index> ends = facets.corners.row(f);
  const Index last = ends.size() > 2 ? ends[2] : ends[1];
  return {point_of(particles.positions, particles.dim, ends[0]),
          point_of(particles.positions, particles.dim, ends[1]),
          point_of(particles.positions, particles.dim, last), ends.size() == 2};
}

}  // namespace

void refuse_unjoined_parts(const Particles& particles, const Facets& facets) {
  const int dim = particles.dim;
  std::vector<Index> vertices;
  std::map<int, std::vector<Index>> facets_by_size;  // within a factor of two of each other
  for (Index f = 0; f < facets.size(); ++f) {
    if (!facets.on_surface(f)) continue;
    const std::span<const Index> ends = facets.corners.row(f);
    vertices.insert(vertices.end(), ends.begin(), ends.end());
    facets_by_size[std::ilogb(size_of(corners_of(particles, facets, f)))].push_back(f);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<double> points;
  for (const Index i : vertices) {
    const auto x = particles.position(i);
    points.insert(points.end(), x.begin(), x.end());
  }
  for (const auto& [exponent, group] : facets_by_size) {
    std::vector<double> centres;
    for (const Index f : group) {
      const Vector3 centre = facets.centre(f, particles.positions);
      centres.insert(centres.end(), centre.begin(), centre.begin() + dim);
    }
    const double largest = std::ldexp(2.0, exponent);
    const Csr near = find_neighbors(points, centres, dim, largest);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const Corners corners = corners_of(particles, facets, group[k]);
      const std::span<const Index> ends = facets.corners.row(group[k]);
      for (const Index number : near.row(static_cast<Index>(k))) {
        const Index i = vertices[number];
        if (std::find(ends.begin(), ends.end(), i) != ends.end()) continue;
        const Vector3 x = point_of(particles.positions, dim, i);
        if (!lies_on(corners, x, touching * size_of(corners))) continue;
        throw std::invalid_argument(fmt::format(
            "the vertex at ({:.6g}) lies on the side of a cell without being its corner: parts of the "
            "mesh touch and are not joined",
            fmt::join(x.begin(), x.begin() + dim, ", ")));
      }
    }
  }
}

}  // namespace perilink
