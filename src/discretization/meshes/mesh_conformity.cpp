#include "discretization/meshes/mesh_conformity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// A vertex this close to a facet lies on it, in sizes of the facet. Meshes are written with 16
/// digits; the distance between a curve and its chord is far larger.
constexpr double touching = 1e-7;

/// Whether a point lies on the facet, its border included.
bool lies_on(const FacetGeometry& facet, const Vector3& x) {
  return norm(minus(x, nearest_point(facet, x))) <= touching * facet.size;
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
    facets_by_size[std::ilogb(facet_geometry(particles, facets, f).size)].push_back(f);
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
      const FacetGeometry facet = facet_geometry(particles, facets, group[k]);
      const std::span<const Index> ends = facets.corners.row(group[k]);
      for (const Index number : near.row(static_cast<Index>(k))) {
        const Index i = vertices[number];
        if (std::find(ends.begin(), ends.end(), i) != ends.end()) continue;
        const Vector3 x = point_of(particles.positions, dim, i);
        if (!lies_on(facet, x)) continue;
        throw std::invalid_argument(fmt::format(
            "the vertex at ({:.6g}) lies on the side of a cell without being its corner: parts of "
            "the mesh touch and are not joined",
            fmt::join(x.begin(), x.begin() + dim, ", ")));
      }
    }
  }
}

}  // namespace perilink
