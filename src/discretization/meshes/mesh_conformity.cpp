#include "discretization/meshes/mesh_conformity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/joined_parts.hpp"
#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// A vertex this close to a facet lies on it [facet sizes]. Mesh files have 16 digits, and a curve
/// is much farther from its chord.
constexpr double touching = 1e-7;

/// Returns whether a point lies on the facet or its border.
bool lies_on(const FacetGeometry& facet, const Vector3& x) {
  return norm(minus(x, nearest_point(facet, x))) <= touching * facet.size;
}

}  // namespace

void refuse_unjoined_parts(const Particles& particles, const Facets& facets) {
  const int dim = particles.dim;
  std::vector<Index> vertices;
  std::map<int, std::vector<Index>> facets_by_size;  // sizes within a factor of two
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
            "the vertex at ({}) lies on the side of a cell without being its corner: parts of "
            "the mesh touch and are not joined",
            joined({x.data(), static_cast<std::size_t>(dim)})));
      }
    }
  }
}

namespace {

/// Side of a cell with duplicate corners.
struct TwinSide {
  std::array<Index, 3> corners{no_index, no_index, no_index};  ///< the cell lies to their left
};

/// Returns the first point at the position of each point.
std::vector<Index> first_at_place(const Mesh& mesh) {
  const auto at = [&](Index i) { return point_of(mesh.positions, mesh.dim, i); };
  std::vector<Index> order(static_cast<std::size_t>(mesh.num_points()));
  std::iota(order.begin(), order.end(), 0);
  std::vector<Index> first = order;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return at(a) < at(b); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (at(order[k]) == at(order[k - 1])) first[order[k]] = first[order[k - 1]];
  }
  return first;
}

/// Returns sides of cells with a duplicate corner, by the first points at their corners.
std::map<std::array<Index, 3>, std::vector<TwinSide>> twin_sides(
    const Mesh& mesh, const std::vector<Index>& place, const std::vector<std::uint8_t>& has_twin) {
  std::map<std::array<Index, 3>, std::vector<TwinSide>> sides;
  const int dim = mesh.dim;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::span<const Index> own(mesh.cells.data() + std::size_t(cell) * (dim + 1), dim + 1);
    if (std::ranges::none_of(own, [&](Index i) { return has_twin[i] != 0; })) continue;
    for (int opposite = 0; opposite <= dim; ++opposite) {
      TwinSide side;
      std::array<Index, 3> key{no_index, no_index, no_index};
      for (int k = 0; k < dim; ++k) {
        side.corners[k] = own[(opposite + 1 + k) % (dim + 1)];
        key[k] = place[side.corners[k]];
      }
      const auto is_twin = [&](Index i) { return i != no_index && has_twin[i] != 0; };
      if (std::ranges::none_of(side.corners, is_twin)) continue;
      std::array<Index, 4> corners{side.corners[0], side.corners[1], side.corners[2],
                                   own[opposite]};
      if (dim == 2) corners[2] = own[opposite];
      if (signed_volume(mesh.positions, dim, std::span(corners.data(), dim + 1)) < 0.0) {
        std::swap(side.corners[0], side.corners[1]);
      }
      std::ranges::sort(key);
      sides[key].push_back(side);
    }
  }
  return sides;
}

/// Returns pairs of coincident sides of cells that are connected elsewhere.
std::vector<std::array<TwinSide, 2>> find_slits(const Mesh& mesh, const std::vector<Index>& place,
                                                const std::vector<std::uint8_t>& has_twin) {
  const std::size_t width = mesh.dim + 1;
  JoinedParts parts(mesh.num_points());
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    parts.join(mesh.cells[k], mesh.cells[k - k % width]);
  }
  std::vector<std::array<TwinSide, 2>> slits;
  for (const auto& [key, sides] : twin_sides(mesh, place, has_twin)) {
    if (sides.size() != 2) continue;
    std::array<std::array<Index, 3>, 2> own{sides[0].corners, sides[1].corners};
    if (parts.find(own[0][0]) != parts.find(own[1][0])) continue;
    for (auto& corners : own) std::ranges::sort(corners);
    if (own[0] != own[1]) slits.push_back({sides[0], sides[1]});  // equal: inside the body
  }
  return slits;
}

}  // namespace

Index weld_slits(Mesh& mesh) {
  const std::vector<Index> place = first_at_place(mesh);
  std::vector<std::uint8_t> has_twin(place.size(), 0);
  bool twins = false;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == static_cast<Index>(i)) continue;
    has_twin[i] = has_twin[place[i]] = 1;
    twins = true;
  }
  if (!twins) return 0;
  const std::size_t dim = mesh.dim;
  JoinedParts flanks(mesh.num_points());
  const std::vector<std::array<TwinSide, 2>> slits = find_slits(mesh, place, has_twin);
  if (slits.empty()) return 0;
  // Tips belong to both faces, all other corners of a slit to one face.
  const auto for_each_twin = [&](const TwinSide& side, auto visit) {
    for (std::size_t k = 0; k < dim; ++k) {
      if (has_twin[side.corners[k]] != 0) visit(side.corners[k]);
    }
  };
  const auto flank_of = [&](const TwinSide& side) {
    Index flank = no_index;
    for_each_twin(side, [&](Index i) { flank = flanks.find(i); });
    return flank;
  };
  std::vector<Index> welded(place.size());
  std::iota(welded.begin(), welded.end(), 0);
  for (const auto& pair : slits) {
    for (const TwinSide& side : pair) {
      for_each_twin(side, [&](Index i) {
        flanks.join(i, flank_of(side));
        welded[i] = place[i];
      });
    }
  }
  MeshGroup group{slits_of_mesh, mesh.dim - 1, {}, {}};
  for (const auto& [one, other] : slits) {
    const TwinSide& side = flank_of(one) < flank_of(other) ? one : other;
    group.elements.push_back(mesh.num_facets());
    for (std::size_t k = 0; k < dim; ++k) {
      mesh.facets.push_back(side.corners[k]);
      group.points.push_back(side.corners[k]);
    }
  }
  mesh.groups.push_back(std::move(group));
  for (std::vector<Index>* corners : {&mesh.cells, &mesh.facets, &mesh.lines}) {
    for (Index& i : *corners) i = welded[i];
  }
  for (MeshGroup& each : mesh.groups) {
    for (Index& i : each.points) i = welded[i];
    std::ranges::sort(each.points);
    each.points.erase(std::unique(each.points.begin(), each.points.end()), each.points.end());
  }
  return static_cast<Index>(slits.size());
}

}  // namespace perilink
