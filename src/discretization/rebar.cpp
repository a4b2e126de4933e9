#include "discretization/rebar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "discretization/facet_geometry.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// Nodes closer than this are merged [spacings].
constexpr double merge_tolerance = 1e-6;

/// Returns positions of the nodes along a bar.
std::vector<Vector3> nodes_of(const RebarLine& bar, int dim, double spacing, std::size_t number) {
  std::vector<Vector3> corners = {bar.from};
  corners.insert(corners.end(), bar.bends.begin(), bar.bends.end());
  corners.push_back(bar.to);
  std::vector<Vector3> nodes;
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece) {
    Vector3 way{};
    for (int axis = 0; axis < dim; ++axis) {
      way[axis] = corners[piece + 1][axis] - corners[piece][axis];
    }
    const double length = norm(way);
    if (!(length > merge_tolerance * spacing)) {
      throw std::invalid_argument("bar " + std::to_string(number + 1) + " has no length");
    }
    const auto count = std::max(Index{1}, static_cast<Index>(std::lround(length / spacing)));
    for (Index node = piece == 0 ? 0 : 1; node <= count; ++node) {
      Vector3 point{};
      for (int axis = 0; axis < dim; ++axis) {
        point[axis] = corners[piece][axis] + static_cast<double>(node) / count * way[axis];
      }
      nodes.push_back(point);
    }
  }
  return nodes;
}

Index add_node(Particles& particles, const Vector3& point, double volume) {
  particles.positions.insert(particles.positions.end(), point.begin(),
                             point.begin() + particles.dim);
  particles.volumes.push_back(volume);
  particles.material.push_back(no_index);
  particles.kind.push_back(ParticleKind::rebar);
  return particles.size() - 1;
}

/// Returns the particle at each wanted node of bars without embedded points: a solid particle, an
/// earlier node or a new one.
std::vector<Index> place_nodes(Particles& particles, std::span<const double> wanted, double spacing,
                               double cell_volume) {
  const int dim = particles.dim;
  const double tolerance = merge_tolerance * spacing;
  const Csr old_particles = find_neighbors(particles.positions, wanted, dim, tolerance);
  const Csr later_nodes = find_upper_neighbors(wanted, dim, tolerance);
  std::vector<Index> placed(static_cast<std::size_t>(old_particles.rows()), no_index);
  for (Index node = 0; node < old_particles.rows(); ++node) {
    for (const Index candidate : old_particles.row(node)) {
      if (particles.kind[candidate] != ParticleKind::ghost) {
        placed[node] = candidate;
        break;
      }
    }
    if (placed[node] == no_index) {
      Vector3 point{};
      std::copy_n(wanted.begin() + static_cast<std::ptrdiff_t>(node) * dim, dim, point.begin());
      placed[node] = add_node(particles, point, cell_volume);
    }
    for (const Index later : later_nodes.row(node)) {
      if (placed[later] == no_index) placed[later] = placed[node];
    }
  }
  return placed;
}

std::vector<Index> place_embedded(Particles& particles, const std::vector<Vector3>& nodes,
                                  double spacing, double cell_volume) {
  std::vector<Index> placed;
  const bool closed = norm(minus(nodes.back(), nodes.front())) <= merge_tolerance * spacing;
  for (const Vector3& point : nodes) {
    const bool last = placed.size() + 1 == nodes.size();
    placed.push_back(closed && last ? placed.front() : add_node(particles, point, cell_volume));
  }
  return placed;
}

/// Returns the parts of a bar element that the nodes at its two ends tie to the body [-]: half of
/// it each, or what an end in the body has as far as the face.
std::array<double, 2> tied_parts(const RebarLine& bar, const Vector3& begin, const Vector3& end) {
  if (!bar.inside) return {0.5, 0.5};
  const bool first = bar.inside(begin), second = bar.inside(end);
  if (first == second) return first ? std::array{0.5, 0.5} : std::array{0.0, 0.0};
  double in = first ? 0.0 : 1.0, out = 1.0 - in;
  while (std::abs(in - out) > 1e-9) {
    const double middle = 0.5 * (in + out);
    Vector3 point{};
    for (int a = 0; a < 3; ++a) point[a] = begin[a] + middle * (end[a] - begin[a]);
    (bar.inside(point) ? in : out) = middle;
  }
  return first ? std::array{in, 0.0} : std::array{0.0, 1.0 - in};
}

/// Appends the nodes of an embedded bar with their directions and lengths to the mesh.
/// \param parts  tied_parts() of its elements
void note_embedded(const std::vector<Vector3>& nodes, const std::vector<Index>& placed, Index bar,
                   std::span<const std::array<double, 2>> parts, RebarMesh& mesh) {
  const std::size_t count = nodes.size(), own = mesh.embedded.size();
  const bool closed = placed.back() == placed.front();
  for (std::size_t k = 0; k < (closed ? count - 1 : count); ++k) {
    mesh.embedded.push_back(
        {placed[k], bar, {}, 0.0, !closed && k == 0, !closed && k + 1 == count});
  }
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Vector3 way = minus(nodes[k + 1], nodes[k]);
    const double length = norm(way);
    const std::size_t ends[] = {own + k, own + (closed && k + 2 == count ? 0 : k + 1)};
    for (std::size_t end : {0, 1}) {
      BarNode& node = mesh.embedded[ends[end]];
      node.length += parts[k][end] * length;
      for (int a = 0; a < 3; ++a) node.along[a] += way[a] / length;
    }
  }
  for (std::size_t k = own; k < mesh.embedded.size(); ++k) {
    BarNode& node = mesh.embedded[k];
    double length = norm(node.along);
    if (length < 1e-6) {  // the bar reverses its direction
      const std::size_t from = std::max<std::size_t>(k - own, 1) - 1;
      node.along = minus(nodes[from + 1], nodes[from]);
      length = norm(node.along);
    }
    for (double& component : node.along) component /= length;
  }
}

/// Returns bonds between the solid particles and the new nodes, sorted as Bonds.
Bonds join_nodes(const Particles& particles, Index first_node, double horizon) {
  const int dim = particles.dim;
  const auto first_other = std::find_if(particles.kind.begin(), particles.kind.end(),
                                        [](auto kind) { return kind != ParticleKind::solid; });
  const auto num_solid = static_cast<std::size_t>(first_other - particles.kind.begin());
  const std::span<const double> positions(particles.positions);
  const auto nodes = positions.subspan(static_cast<std::size_t>(first_node) * dim);
  const Csr neighbors = find_neighbors(positions.first(num_solid * dim), nodes, dim,
                                       horizon * (1.0 + horizon_tolerance));
  std::vector<std::pair<Index, Index>> pairs;
  for (Index node = 0; node < neighbors.rows(); ++node) {
    for (const Index solid : neighbors.row(node)) pairs.emplace_back(solid, first_node + node);
  }
  std::sort(pairs.begin(), pairs.end());
  Bonds ties;
  ties.dim = dim;
  for (const auto& [solid, node] : pairs) ties.append(particles, solid, node);
  return ties;
}

}  // namespace

RebarMesh add_rebar(Particles& particles, const std::vector<RebarLine>& bars, double spacing,
                    double horizon, double cell_volume) {
  const int dim = particles.dim;
  std::vector<std::vector<Vector3>> nodes;
  std::vector<double> wanted;
  for (std::size_t bar = 0; bar < bars.size(); ++bar) {
    nodes.push_back(nodes_of(bars[bar], dim, spacing, bar));
    if (bars[bar].embedded) continue;
    for (const Vector3& point : nodes.back()) {
      wanted.insert(wanted.end(), point.begin(), point.begin() + dim);
    }
  }
  RebarMesh mesh;
  mesh.segments.dim = dim;
  const Index first_node = particles.size();
  const std::vector<Index> bonded = place_nodes(particles, wanted, spacing, cell_volume);
  mesh.ties = join_nodes(particles, first_node, horizon);
  std::size_t next = 0;
  for (std::size_t bar = 0; bar < bars.size(); ++bar) {
    const std::size_t count = nodes[bar].size();
    const std::size_t first_element = mesh.tied_parts.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      mesh.tied_parts.push_back(tied_parts(bars[bar], nodes[bar][k], nodes[bar][k + 1]));
    }
    std::vector<Index> placed;
    if (bars[bar].embedded) {
      placed = place_embedded(particles, nodes[bar], spacing, cell_volume);
      note_embedded(nodes[bar], placed, static_cast<Index>(bar),
                    std::span(mesh.tied_parts).subspan(first_element), mesh);
    } else {
      const auto first = bonded.begin() + static_cast<std::ptrdiff_t>(next);
      placed.assign(first, first + static_cast<std::ptrdiff_t>(count));
      next += count;
    }
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const auto [low, high] = std::minmax(placed[k], placed[k + 1]);
      mesh.segments.append(particles, low, high);
      mesh.bar_of_element.push_back(static_cast<Index>(bar));
      mesh.turned.push_back(placed[k] > placed[k + 1]);
    }
  }
  return mesh;
}

}  // namespace perilink
