#include "discretization/cuts/outside_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "discretization/facet_geometry.hpp"
#include "discretization/mesh_faces.hpp"
#include "discretization/neighbor_search.hpp"
#include "discretization/region.hpp"

namespace perilink {
namespace {

/// Distances below this are round-off [spacings].
constexpr double round_off = 1e-9;

/// Largest cosine between the normals of opposite flanks: antiparallel to within 60 degrees. At
/// re-entrant corners the cosine is zero.
constexpr double facing = -0.5;

/// Points between two crossings at which the distance from the body is measured. The distance is
/// nearly the greatest at midway.
constexpr int num_stations = 7;

/// Surface of the body and its facets near every particle.
struct BodySurface {
  std::vector<FacetGeometry> facets;
  std::vector<Box> boxes;
  Csr near;            // facets that the particle's bonds can meet
  double touch = 0.0;  // [length]
};

BodySurface surface_of(const Particles& particles, const Bonds& bonds, const Facets& facets,
                       double spacing) {
  BodySurface surface;
  surface.touch = round_off * spacing;
  const int dim = particles.dim;
  std::vector<double> centres;
  double largest = 0.0;
  for (Index f = 0; f < facets.size(); ++f) {
    if (!facets.on_surface(f)) continue;
    for (const FacetGeometry& facet : facet_pieces(particles, facets, f)) {
      Box box;
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({facet.a[axis], facet.b[axis], facet.c[axis]});
        box.lower[axis] = low - surface.touch;
        box.upper[axis] = high + surface.touch;
      }
      const Vector3 centre = facets.centre(f, particles.positions);
      centres.insert(centres.end(), centre.begin(), centre.begin() + dim);
      largest = std::max(largest, facet.size);
      surface.facets.push_back(facet);
      surface.boxes.push_back(box);
    }
  }
  const double longest = *std::max_element(bonds.lengths.begin(), bonds.lengths.end());
  surface.near = find_neighbors(centres, particles.positions, dim, longest + largest);
  return surface;
}

/// Flags particles above the plane of a facet nearby. Bonds between others stay below every facet
/// that they could meet, and so within the body.
std::vector<std::uint8_t> above_facets(const Particles& particles, const BodySurface& surface) {
  std::vector<std::uint8_t> above;
  for (Index i = 0; i < particles.size(); ++i) {
    const Vector3 x = point_of(particles.positions, particles.dim, i);
    above.push_back(std::ranges::any_of(surface.near.row(i), [&](Index f) {
      return height_above(surface.facets[f], x) > surface.touch;
    }));
  }
  return above;
}

/// Intersection of a bond and a facet.
struct Meeting {
  double fraction;  // position over the bond's length
  Index facet;
};

/// Bond and the facets around it.
class Passage {
 public:
  Passage(const BodySurface& surface, std::span<const Index> near, const Vector3& from,
          const Vector3& to)
      : surface_(surface), near_(near), from_(from), to_(to) {
    direction_ = minus(to, from);
    length_ = norm(direction_);
    for (double& component : direction_) component /= length_;
  }

  bool leaves_body(double allowed) {
    if (!find_meetings()) return false;
    std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& a, const Meeting& b) {
      return a.fraction != b.fraction ? a.fraction < b.fraction : a.facet < b.facet;
    });
    // Coincident meetings end one piece of the bond and begin the next.
    const double same = surface_.touch / length_;
    std::size_t begin = 0;
    while (begin < meetings_.size()) {
      std::size_t end = begin + 1;
      while (end < meetings_.size() &&
             meetings_[end].fraction - meetings_[begin].fraction <= same) {
        ++end;
      }
      std::size_t last = end;
      while (last < meetings_.size() &&
             meetings_[last].fraction - meetings_[end].fraction <= same) {
        ++last;
      }
      if (last > end && piece_leaves(begin, end, last, allowed)) return true;
      begin = end;
    }
    return false;
  }

 private:
  /// Returns false if the bond stays below every facet that it could meet, so that it is inside.
  bool find_meetings() {
    bool above = false;
    for (const Index f : near_) {
      const Box& box = surface_.boxes[f];
      bool apart = false;
      for (int axis = 0; axis < 3; ++axis) {
        apart = apart || std::max(from_[axis], to_[axis]) < box.lower[axis] ||
                std::min(from_[axis], to_[axis]) > box.upper[axis];
      }
      if (apart) continue;
      const FacetGeometry& facet = surface_.facets[f];
      const double start = height_above(facet, from_), end = height_above(facet, to_);
      above = above || start > surface_.touch || end > surface_.touch;
      // A bond along a facet meets the facet's neighbours at its ends.
      if (std::abs(start - end) <= surface_.touch) continue;
      const double fraction = start / (start - end);
      if (fraction < -1e-9 || fraction > 1.0 + 1e-9) continue;
      const Vector3 point = between(from_, to_, fraction);
      if (norm(minus(point, nearest_point(facet, point))) > surface_.touch) continue;
      meetings_.push_back({std::clamp(fraction, 0.0, 1.0), f});
    }
    return above;
  }

  /// Returns the distance from the surface, positive outside. Among equally near facets, the one
  /// with the largest height below the point decides the sign.
  double distance(const Vector3& point) const {
    double least = std::numeric_limits<double>::infinity(), height = 0.0;
    for (const Index f : near_) {
      const FacetGeometry& facet = surface_.facets[f];
      const double away = norm(minus(point, nearest_point(facet, point)));
      if (away > least + surface_.touch) continue;
      const double above = height_above(facet, point);
      if (away < least - surface_.touch || std::abs(above) > std::abs(height)) height = above;
      least = std::min(least, away);
    }
    return height > 0.0 ? least : -least;
  }

  /// Returns whether the piece between the meetings [begin, end) and [end, last) leaves the body.
  bool piece_leaves(std::size_t begin, std::size_t end, std::size_t last, double allowed) const {
    const double start = meetings_[begin].fraction, stop = meetings_[end].fraction;
    const auto place = [&](double part) {
      return between(from_, to_, start + part * (stop - start));
    };
    if (distance(place(0.5)) <= surface_.touch) return false;
    for (std::size_t out = begin; out < end; ++out) {
      const Vector3& normal = surface_.facets[meetings_[out].facet].normal;
      if (dot(normal, direction_) <= 0.0) continue;
      for (std::size_t in = end; in < last; ++in) {
        const Vector3& other = surface_.facets[meetings_[in].facet].normal;
        if (dot(other, direction_) < 0.0 && dot(normal, other) < facing) return true;
      }
    }
    for (int station = 1; station <= num_stations; ++station) {
      if (distance(place(station / (num_stations + 1.0))) > allowed) return true;
    }
    return false;
  }

  const BodySurface& surface_;
  std::span<const Index> near_;
  Vector3 from_, to_, direction_{};
  double length_ = 0.0;
  std::vector<Meeting> meetings_;
};

}  // namespace

Index remove_bonds_outside(const Particles& particles, Bonds& bonds, const Facets& facets,
                           double spacing) {
  if (bonds.size() == 0) return 0;
  const BodySurface surface = surface_of(particles, bonds, facets, spacing);
  const std::vector<std::uint8_t> above = above_facets(particles, surface);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(bonds.size()), 1);
#pragma omp parallel for schedule(dynamic, 4096)
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.first[b], j = bonds.second[b];
    if (above[i] == 0 && above[j] == 0) continue;
    const auto near_i = surface.near.row(i), near_j = surface.near.row(j);
    if (near_i.empty() || near_j.empty()) continue;  // meetings are near both ends
    Passage passage(surface, near_i, point_of(particles.positions, particles.dim, i),
                    point_of(particles.positions, particles.dim, j));
    keep[b] = passage.leaves_body(allowed_excursion * spacing) ? 0 : 1;
  }
  return keep_bonds(bonds, keep);
}

}  // namespace perilink
