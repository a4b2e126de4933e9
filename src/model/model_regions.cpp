#include "model/model_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/meshes/cell_search.hpp"
#include "io/case/case_words.hpp"

namespace perilink {
namespace {

/// Distance within which particles and facet centres lie inside a region, in spacings.
constexpr double region_tolerance = 1e-6;

/// Returns the region of the case; null for "body" and "surface", which every case has.
const Region* find_region(const CaseFile& input, const std::string& name) {
  const auto found = std::find_if(input.regions.begin(), input.regions.end(),
                                  [&](const Region& region) { return region.name == name; });
  return found == input.regions.end() ? nullptr : &*found;
}

std::vector<Index> corners_of_surface(const Facets& facets) {
  std::vector<Index> corners;
  for (Index facet = 0; facet < facets.size(); ++facet) {
    if (!facets.on_surface(facet)) continue;
    const std::span<const Index> row = facets.corners.row(facet);
    corners.insert(corners.end(), row.begin(), row.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

using Piece = std::vector<Vector3>;  ///< corners of a point, a line, a triangle or a rectangle

Piece piece_of(const Particles& particles, std::span<const Index> corners) {
  Piece piece;
  for (const Index i : corners) piece.push_back(point_of(particles.positions, particles.dim, i));
  return piece;
}

/// Points, lines or triangles of a group without cells.
std::vector<Piece> pieces_of(const Model& model, const Group& group) {
  std::vector<Piece> pieces;
  const auto at = [&](Index k) { return point_of(group.line_points, 3, k); };
  for (std::size_t k = 0; k + 1 < group.lines.size(); k += 2) {
    pieces.push_back({at(group.lines[k]), at(group.lines[k + 1])});
  }
  const auto points = static_cast<Index>(group.line_points.size() / 3);
  for (Index k = 0; k < points && group.lines.empty(); ++k) pieces.push_back({at(k)});
  const Particles& particles = model.network.particles;
  const auto dim = static_cast<std::size_t>(particles.dim);
  for (std::size_t k = 0; dim == 3 && k < group.sides.size(); k += dim) {
    pieces.push_back(piece_of(particles, std::span(group.sides).subspan(k, dim)));
  }
  return pieces;
}

std::vector<Piece> pieces_of_surface(const Model& model) {
  std::vector<Piece> pieces;
  for (Index facet = 0; facet < model.facets.size(); ++facet) {
    if (!model.facets.on_surface(facet)) continue;
    pieces.push_back(piece_of(model.network.particles, model.facets.corners.row(facet)));
  }
  return pieces;
}

bool lies_on(const Piece& piece, const Vector3& point, double tolerance) {
  for (int a = 0; a < 3; ++a) {
    const auto by_axis = [a](const Vector3& p, const Vector3& q) { return p[a] < q[a]; };
    const auto [low, high] = std::minmax_element(piece.begin(), piece.end(), by_axis);
    if (point[a] < (*low)[a] - tolerance || point[a] > (*high)[a] + tolerance) return false;
  }
  if (piece.size() != 2 && piece.size() != 3) return true;  // its box is the piece itself
  const FacetGeometry facet{piece.size() == 2, piece[0], piece[1], piece.back()};
  return norm(minus(nearest_point(facet, point), point)) <= tolerance;
}

/// Adds bar nodes on the surface, or on points, lines, sides or cells of a group; these nodes are
/// not mesh vertices.
/// \param group  null: the surface
void add_bar_nodes(const Model& model, const Group* group, std::vector<Index>& members) {
  const Particles& particles = model.network.particles;
  if (model.network.bars.bar.empty()) return;
  const double tolerance = region_tolerance * model.lattice.spacing;
  const auto add = [&](auto is_inside) {
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] != ParticleKind::rebar) continue;
      if (is_inside(point_of(particles.positions, particles.dim, i))) members.push_back(i);
    }
  };
  if (group != nullptr && !group->cells.empty()) {
    Mesh mesh;
    mesh.dim = particles.dim;
    mesh.positions = particles.positions;
    mesh.cells = model.cells.vertices;
    const CellSearch cells(mesh, group->cells, tolerance);
    return add([&](const Vector3& point) { return cells.contains(point); });
  }
  const auto pieces = group == nullptr ? pieces_of_surface(model) : pieces_of(model, *group);
  add([&](const Vector3& point) {
    return std::ranges::any_of(
        pieces, [&](const Piece& piece) { return lies_on(piece, point, tolerance); });
  });
}

std::vector<Index> particles_inside(const Model& model, const Region* region,
                                    const std::string& name) {
  std::vector<Index> inside;
  if (region == nullptr && name == surface_region) {
    inside = corners_of_surface(model.facets);
    add_bar_nodes(model, nullptr, inside);
    return inside;
  }
  if (region != nullptr && !region->group.empty()) {
    const Group& group = group_named(model, region->group);
    inside = group.particles;
    add_bar_nodes(model, &group, inside);
    return inside;
  }
  const Particles& particles = model.network.places();
  const double tolerance = region_tolerance * model.lattice.spacing;
  for (Index i = 0; i < particles.size(); ++i) {
    if (!is_material(particles.kind[i])) continue;
    if (region == nullptr || region->contains(particles.position(i), tolerance)) {
      inside.push_back(i);
    }
  }
  return inside;
}

double distance(const Region& region, std::span<const double> point) {
  if (region.round && !region.round->axis) return region.round->distance(point);
  double square = 0.0;
  for (std::size_t a = 0; a < point.size(); ++a) {
    const double outside =
        std::max({region.box.lower[a] - point[a], point[a] - region.box.upper[a], 0.0});
    square += outside * outside;
  }
  return std::sqrt(square);
}

/// Returns the position of the particle nearest to a box or round region; empty for groups.
std::string nearest_text(const Particles& particles, const Region* region) {
  if (region == nullptr || !region->group.empty()) return "";
  Index nearest = no_index;
  double least = INFINITY;
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid) continue;
    const double away = distance(*region, particles.position(i));
    if (away < least) {
      least = away;
      nearest = i;
    }
  }
  if (nearest == no_index) return "";
  return fmt::format("the nearest one is {:.4g} outside, at ({}); ", least,
                     joined(particles.position(nearest)));
}

[[noreturn]] void refuse_without_facets(const CaseFile& input, const Model& model,
                                        const Region& region, const std::string& key) {
  if (!region.group.empty()) {
    throw InputError(input.where(key),
                     fmt::format("is \"{}\", but tractions act on the surface, and no facet of it "
                                 "belongs to the physical group \"{}\"",
                                 region.name, region.group),
                     "give the lines (2D) or faces (3D) that are loaded a physical group");
  }
  Vector3 nearest{};
  double least = INFINITY;
  for (Index facet = 0; facet < model.facets.size(); ++facet) {
    if (!model.facets.on_surface(facet)) continue;
    const Vector3 centre = model.facets.centre(facet, model.network.places().positions);
    const double away =
        distance(region, {centre.data(), static_cast<std::size_t>(model.facets.dim)});
    if (away < least) {
      least = away;
      nearest = centre;
    }
  }
  throw InputError(
      input.where(key),
      fmt::format("is \"{}\", but tractions act on the surface, and no facet of it has its centre "
                  "in that region",
                  region.name),
      fmt::format("the nearest facet has its centre at ({})",
                  joined({nearest.data(), static_cast<std::size_t>(model.facets.dim)})));
}

}  // namespace

const Group& group_named(const Model& model, const std::string& name) {
  // Where several groups have this name, the last one has the highest dimension.
  return *std::find_if(model.groups.rbegin(), model.groups.rend(),
                       [&](const Group& group) { return group.name == name; });
}

std::vector<Index> particles_of_region(const CaseFile& input, const Model& model,
                                       const std::string& region, const std::string& key) {
  const Particles& particles = model.network.places();
  std::vector<Index> inside = particles_inside(model, find_region(input, region), region);
  const bool any = std::any_of(inside.begin(), inside.end(),
                               [&](Index i) { return is_material(particles.kind[i]); });
  if (!any) {
    throw InputError(
        input.where(key), fmt::format("no particle lies in the region \"{}\"", region),
        fmt::format("{}the spacing is {:.6g}; make the region larger or move it onto the "
                    "body",
                    nearest_text(particles, find_region(input, region)), model.lattice.spacing));
  }
  return inside;
}

std::vector<Index> particles_of_plane(const CaseFile& input, const Model& model, std::size_t k) {
  const SymmetrySection& plane = input.symmetry[k];
  if (!plane.at) {
    return particles_of_region(input, model, plane.region, item_key("symmetry", k, "region"));
  }
  const Particles& particles = model.network.places();
  std::vector<Index> inside;
  for (Index i = 0; i < particles.size(); ++i) {
    const double away = std::abs(particles.position(i)[plane.axis] - *plane.at);
    const bool is_near = away <= region_tolerance * model.lattice.spacing;
    if (is_near && is_material(particles.kind[i])) inside.push_back(i);
  }
  return inside;
}

std::vector<Index> facets_of_region(const CaseFile& input, const Model& model,
                                    const std::string& region, const std::string& key) {
  const Region* own = find_region(input, region);
  const Facets& facets = model.facets;
  const double tolerance = region_tolerance * model.lattice.spacing;
  std::vector<Index> inside;
  if (own != nullptr && !own->group.empty()) {
    inside = group_named(model, own->group).facets;
  } else {
    for (Index facet = 0; facet < facets.size(); ++facet) {
      if (!facets.on_surface(facet)) continue;
      const Vector3 centre = facets.centre(facet, model.network.places().positions);
      const std::span<const double> point(centre.data(), static_cast<std::size_t>(facets.dim));
      if (own == nullptr || own->contains(point, tolerance)) inside.push_back(facet);
    }
  }
  if (inside.empty()) refuse_without_facets(input, model, *own, key);
  return inside;
}

NearestParticle nearest_particle(const Particles& particles, std::span<const double> point) {
  NearestParticle nearest{no_index, INFINITY};
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid) continue;
    double square = 0.0;
    for (int a = 0; a < particles.dim; ++a) {
      const double away = particles.position(i)[a] - point[a];
      square += away * away;
    }
    const double distance = std::sqrt(square);
    if (distance < nearest.distance) nearest = {i, distance};
  }
  return nearest;
}

double spacing_around(const Model& model, Index particle) {
  const Network& network = model.network;
  double shortest = infinity, longest_edge = model.lattice.spacing;
  for (Index e = 0; e < network.first_contact(); ++e) {
    if (network.bonds.first[e] != particle && network.bonds.second[e] != particle) continue;
    const double length = network.bonds.length(e);
    shortest = std::min(shortest, length);
    const bool is_edge = model.elements || e >= network.num_bonds();
    if (is_edge) longest_edge = std::max(longest_edge, length);
  }
  return shortest < infinity ? std::max(shortest, longest_edge) : longest_edge;
}

}  // namespace perilink
