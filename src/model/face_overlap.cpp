#include "model/face_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "base/plain_text.hpp"
#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

constexpr double reach = 1.5;       // spacings between particles on the two faces
constexpr double noticeable = 3.0;  // overlap over the shortening of intact bonds

/// Displacements and places of the particles of a body.
struct Moved {
  const Network& network;
  std::span<const double> motion;

  Vector3 place(Index i) const { return point_of(network.particles.positions, network.dim(), i); }
  /// Returns by how much two particles approach each other along a direction [length].
  double approach(Index i, Index j, const Vector3& direction) const {
    const auto width = static_cast<std::size_t>(network.width());
    double sum = 0.0;
    for (int a = 0; a < network.dim(); ++a) {
      sum += (motion[i * width + a] - motion[j * width + a]) * direction[a];
    }
    return sum;
  }
};

/// Returns the largest shortening of the short bonds [length].
double largest_shortening(const Moved& body, double longest) {
  const Network& network = body.network;
  double largest = 0.0;
  for (Index b = 0; b < network.num_bonds(); ++b) {
    if (network.bonds.length(b) > longest) continue;
    const Vector3 direction = point_of(network.bonds.direction(b), network.dim(), 0);
    largest = std::max(largest,
                       body.approach(network.bonds.first[b], network.bonds.second[b], direction));
  }
  return largest;
}

/// Returns the particles of the solid in the box around all cracks and one reach beyond.
std::vector<Index> particles_near(const CrackCutter& cutter, const Network& network,
                                  double distance) {
  std::vector<Index> near;
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (network.particles.kind[i] != ParticleKind::solid) continue;
    const auto x = network.particles.position(i);
    bool inside = true;
    for (int a = 0; a < network.dim(); ++a) {
      inside =
          inside && x[a] >= cutter.lower()[a] - distance && x[a] <= cutter.upper()[a] + distance;
    }
    if (inside) near.push_back(i);
  }
  return near;
}

using Pair = std::pair<Index, Index>;

/// Returns the pairs of particles up to a distance apart that no bond joins, near the cracks.
std::vector<Pair> parted_pairs(const CrackCutter& cutter, const Network& network, double distance) {
  const std::vector<Index> near = particles_near(cutter, network, distance);
  std::vector<double> places;
  std::vector<std::uint8_t> is_near(static_cast<std::size_t>(network.particles.size()), 0);
  for (const Index i : near) {
    const auto x = network.particles.position(i);
    places.insert(places.end(), x.begin(), x.end());
    is_near[i] = 1;
  }
  std::set<Pair> bonded;
  for (Index b = 0; b < network.num_bonds(); ++b) {
    const Index i = network.bonds.first[b], j = network.bonds.second[b];
    if (network.bonds.length(b) > distance || is_near[i] == 0 || is_near[j] == 0) continue;
    bonded.insert({std::min(i, j), std::max(i, j)});
  }
  const Csr around = find_neighbors_within(places, places, network.dim(),
                                           std::vector<double>(near.size(), distance));
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < near.size(); ++k) {
    for (const Index l : around.row(static_cast<Index>(k))) {
      const Pair pair{near[k], near[l]};
      if (pair.first < pair.second && !bonded.contains(pair)) pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace

FaceOverlap deepest_overlap(const Model& model, std::span<const double> motion,
                            const FaceOverlap& so_far) {
  const Network& network = model.network;
  std::vector<Crack> cracks;
  std::vector<std::size_t> entries;
  if (network.shell || network.num_contacts > 0) return so_far;
  for (std::size_t k = 0; k < model.cracks.size(); ++k) {
    if (model.cracks[k].closes) continue;
    cracks.push_back(model.cracks[k]);
    entries.push_back(model.entry_of_crack[k]);
  }
  if (cracks.empty()) return so_far;
  const Moved body{network, motion};
  const double spacing = model.lattice.spacing, longest = reach * spacing;
  const double least = noticeable * largest_shortening(body, longest);
  // Particles on a crack belong to either side: on joints to the weaker one.
  const CrackCutter drawn(cracks, network.dim(), spacing);
  for (Crack& crack : cracks) std::ranges::reverse(crack.points);
  const CrackCutter turned(cracks, network.dim(), spacing);
  FaceOverlap deepest = so_far;
  for (const auto& [i, j] : parted_pairs(drawn, network, longest)) {
    const Vector3 from = body.place(i), way = minus(body.place(j), from);
    for (const CrackCutter* cutter : {&drawn, &turned}) {
      const CrackCutter::Piece* piece = cutter->piece_between(from, body.place(j));
      if (piece == nullptr) continue;
      // A rotation does not change the length of the way, nor a slip that along the normal.
      const double along = body.approach(i, j, way) / norm(way);
      const double across =
          std::copysign(1.0, dot(way, piece->normal)) * body.approach(i, j, piece->normal);
      const double depth = std::min(along, across);
      if (depth > std::max(least, deepest.depth)) {
        deepest = {depth, from, entries[piece->crack]};
      }
    }
  }
  return deepest;
}

std::optional<std::string> warning_about_overlap(const FaceOverlap& overlap, int dim) {
  if (overlap.depth == 0.0) return std::nullopt;
  return fmt::format(
      "the faces of crack {} pass through each other, by up to {:.3g} near ({}): let them press on "
      "each other by closing = true in its [[cracks]]; closing = false means a gap",
      overlap.entry + 1, overlap.depth,
      joined(std::span(overlap.place.data(), static_cast<std::size_t>(dim))));
}

}  // namespace perilink
