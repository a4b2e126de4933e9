#include "discretization/rebar.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

/// Nodes closer than this are one, in spacings.
constexpr double merge_tolerance = 1e-6;

Vector3 along(const RebarLine& bar, double fraction, int dim) {
  Vector3 point{};
  for (int axis = 0; axis < dim; ++axis) {
    point[axis] = bar.from[axis] + fraction * (bar.to[axis] - bar.from[axis]);
  }
  return point;
}

Index count_segments(const RebarLine& bar, int dim, double spacing, std::size_t number) {
  Vector3 vector{};
  for (int axis = 0; axis < dim; ++axis) vector[axis] = bar.to[axis] - bar.from[axis];
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  if (!(length > merge_tolerance * spacing)) {
    throw std::invalid_argument("bar " + std::to_string(number + 1) + " has no length");
  }
  return std::max(Index{1}, static_cast<Index>(std::lround(length / spacing)));
}

/// Number of the particle at each wanted node: a solid particle, an earlier node, or a new one.
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
      placed[node] = particles.size();
      const auto begin = wanted.begin() + static_cast<std::ptrdiff_t>(node) * dim;
      particles.positions.insert(particles.positions.end(), begin, begin + dim);
      particles.volumes.push_back(cell_volume);
      particles.material.push_back(no_index);
      particles.kind.push_back(ParticleKind::rebar);
    }
    for (const Index later : later_nodes.row(node)) {
      if (placed[later] == no_index) placed[later] = placed[node];
    }
  }
  return placed;
}

/// Bonds between the solid particles and the new nodes, in the order of Bonds.
Bonds tie_nodes(const Particles& particles, Index first_node, double horizon) {
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
  std::vector<double> wanted;
  std::vector<Index> segments_of_bar;
  for (std::size_t bar = 0; bar < bars.size(); ++bar) {
    const Index count = count_segments(bars[bar], dim, spacing, bar);
    segments_of_bar.push_back(count);
    for (Index node = 0; node <= count; ++node) {
      const Vector3 point = along(bars[bar], static_cast<double>(node) / count, dim);
      wanted.insert(wanted.end(), point.begin(), point.begin() + dim);
    }
  }
  const Index first_node = particles.size();
  const std::vector<Index> placed = place_nodes(particles, wanted, spacing, cell_volume);

  RebarMesh mesh;
  mesh.segments.dim = dim;
  std::size_t node = 0;
  for (std::size_t bar = 0; bar < bars.size(); ++bar, ++node) {
    for (Index segment = 0; segment < segments_of_bar[bar]; ++segment, ++node) {
      const auto [low, high] = std::minmax(placed[node], placed[node + 1]);
      mesh.segments.append(particles, low, high);
      mesh.bar_of_segment.push_back(static_cast<Index>(bar));
      mesh.turned.push_back(placed[node] > placed[node + 1]);
    }
  }
  mesh.ties = tie_nodes(particles, first_node, horizon);
  return mesh;
}

}  // namespace perilink
