#include "assembly/distributed_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace perilink {
namespace {

/// A point of a quadrature rule: weight as a fraction of the whole, and the shape functions of the
/// corners.
struct RulePoint {
  double weight;
  std::array<double, 4> shape;
};
using Rule = std::vector<RulePoint>;

/// Gauss–Legendre rule of three points on [0, 1], exact to order five.
struct GaussPoint {
  double weight;
  double place;
};
const std::array<GaussPoint, 3>& gauss() {
  static const double reach = 0.5 * std::sqrt(0.6);
  static const std::array<GaussPoint, 3> points = {
      {{5.0 / 18.0, 0.5 - reach}, {8.0 / 18.0, 0.5}, {5.0 / 18.0, 0.5 + reach}}};
  return points;
}

Rule edge_rule() {
  Rule rule;
  for (const GaussPoint& g : gauss()) rule.push_back({g.weight, {1.0 - g.place, g.place}});
  return rule;
}

/// Corners run around the rectangle.
Rule rectangle_rule() {
  Rule rule;
  for (const GaussPoint& g : gauss()) {
    for (const GaussPoint& h : gauss()) {
      const double s = g.place, t = h.place;
      rule.push_back({g.weight * h.weight, {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}});
    }
  }
  return rule;
}

/// Six points, exact to order four (Strang & Fix 1973; Dunavant 1985).
Rule triangle_rule() {
  const double root = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
  Rule rule;
  for (const double sign : {1.0, -1.0}) {
    const double a = (8.0 - std::sqrt(10.0) + sign * root) / 18.0;
    const double b = 1.0 - 2.0 * a;
    const double weight = (620.0 + sign * std::sqrt(213125.0 - 53320.0 * std::sqrt(10.0))) / 3720.0;
    rule.push_back({weight, {b, a, a}});
    rule.push_back({weight, {a, b, a}});
    rule.push_back({weight, {a, a, b}});
  }
  return rule;
}

/// Corners and centres of the faces, exact to order three.
Rule tetrahedron_rule() {
  Rule rule;
  for (std::size_t k = 0; k < 4; ++k) {
    RulePoint corner{1.0 / 40.0, {}};
    corner.shape[k] = 1.0;
    RulePoint side{9.0 / 40.0, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
    side.shape[k] = 0.0;
    rule.push_back(corner);
    rule.push_back(side);
  }
  return rule;
}

const Rule& facet_rule(int dim, std::size_t corners) {
  static const Rule edge = edge_rule();
  static const Rule triangle = triangle_rule();
  static const Rule rectangle = rectangle_rule();
  static const Rule two = {{0.5, {1.0, 0.0}}, {0.5, {0.0, 1.0}}};
  switch (corners) {
    case 2: return dim == 2 ? edge : two;
    case 3: return triangle;
    default: return rectangle;
  }
}

Vector3 place_of(const Particles& particles, std::span<const Index> corners,
                 const RulePoint& point) {
  Vector3 x{};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (int a = 0; a < particles.dim; ++a) {
      x[a] += point.shape[c] * particles.position(corners[c])[a];
    }
  }
  return x;
}

std::size_t width_of(const Particles& particles, const Loads& loads) {
  return loads.forces.size() / static_cast<std::size_t>(particles.size());
}

double cell_volume(const Particles& particles, std::span<const Index> cell) {
  const int dim = static_cast<int>(cell.size()) - 1;  // a mid-surface in space has triangles
  std::array<Vector3, 3> edges{};
  for (int k = 0; k < dim; ++k) {
    for (int a = 0; a < dim; ++a) {
      edges[k][a] = particles.position(cell[k + 1])[a] - particles.position(cell[0])[a];
    }
  }
  if (dim == 2) {
    return 0.5 * std::abs(edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]);
  }
  double product = 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    product += edges[0][a] * (edges[1][b] * edges[2][c] - edges[1][c] * edges[2][b]);
  }
  return std::abs(product) / 6.0;
}

/// Returns whether all corners belong to the region.
bool is_whole(std::span<const Index> corners, std::span<const std::uint8_t> is_member) {
  return std::all_of(corners.begin(), corners.end(), [&](Index i) { return is_member[i] != 0; });
}

std::vector<double> cell_shares(const Particles& particles, const Simplices& cells,
                                std::span<const std::uint8_t> is_member) {
  std::vector<double> shares(is_member.size(), 0.0);
  for (Index number = 0; number < cells.size(); ++number) {
    const std::span<const Index> cell = cells.cell(number);
    if (!is_whole(cell, is_member)) continue;
    for (const Index i : cell) shares[i] += cell_volume(particles, cell);
  }
  return shares;
}

std::vector<double> facet_shares(const Facets& facets, std::span<const std::uint8_t> is_member) {
  std::vector<double> shares(is_member.size(), 0.0);
  for (Index facet = 0; facet < facets.size(); ++facet) {
    const std::span<const Index> corners = facets.corners.row(facet);
    if (!facets.on_surface(facet) || !is_whole(corners, is_member)) continue;
    double square = 0.0;
    for (const double component : facets.area_vector(facet)) square += component * component;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      shares[corners[c]] += std::sqrt(square) * facets.shares[facets.corners.offsets[facet] + c];
    }
  }
  return shares;
}

}  // namespace

double add_surface_load(const Particles& particles, const Facets& facets,
                        std::span<const Index> members, const SurfaceLoad& load, Loads& loads) {
  const int dim = particles.dim;
  double sizes = 0.0;
  const std::size_t width = width_of(particles, loads);
  for (const Index facet : members) {
    Vector3 normal{};
    double square = 0.0;
    for (int a = 0; a < dim; ++a) {
      normal[a] = facets.area_vector(facet)[a];
      square += normal[a] * normal[a];
    }
    const double area = std::sqrt(square);
    for (double& component : normal) component /= area;
    const std::span<const Index> corners = facets.corners.row(facet);
    // Calibrated bonds balance nodal fractions that differ a little from the integrals of shape
    // functions.
    const auto shift = [&](std::size_t c) {
      return facets.shares[facets.corners.offsets[facet] + c] -
             1.0 / static_cast<double>(corners.size());
    };
    for (const RulePoint& point : facet_rule(dim, corners.size())) {
      const Vector3 x = place_of(particles, corners, point);
      const Vector3 t = load({x.data(), static_cast<std::size_t>(dim)}, normal);
      sizes += area * point.weight * std::hypot(t[0], t[1], t[2]);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        for (int a = 0; a < dim; ++a) {
          loads.forces[corners[c] * width + a] +=
              area * point.weight * (point.shape[c] + shift(c)) * t[a];
        }
      }
    }
  }
  return sizes;
}

std::vector<double> force_shares(const Particles& particles, const Simplices& cells,
                                 const Facets& facets, std::span<const Index> members) {
  std::vector<std::uint8_t> is_member(static_cast<std::size_t>(particles.size()), 0);
  for (const Index i : members) is_member[i] = 1;
  const auto misses_some = [&](const std::vector<double>& shares) {
    return std::any_of(members.begin(), members.end(), [&](Index i) { return shares[i] == 0.0; });
  };
  std::vector<double> shares = cell_shares(particles, cells, is_member);
  if (cells.size() > 0 && misses_some(shares)) shares = facet_shares(facets, is_member);
  if (misses_some(shares)) shares = particles.volumes;
  return shares;
}

void add_lumped_body_load(const Particles& particles, std::span<const Index> members,
                          const BodyLoad& load, Loads& loads) {
  const std::size_t width = width_of(particles, loads);
  for (const Index i : members) {
    const Vector3 b = load(particles.position(i));
    for (int a = 0; a < particles.dim; ++a) {
      loads.forces[i * width + a] += b[a] * particles.volumes[i];
    }
  }
}

void add_cell_body_load(const Particles& particles, const Simplices& cells, double thickness,
                        std::span<const std::uint8_t> is_member, const BodyLoad& load,
                        Loads& loads) {
  static const Rule triangle = triangle_rule();
  static const Rule tetrahedron = tetrahedron_rule();
  const int dim = particles.dim;
  const std::size_t width = width_of(particles, loads);
  for (Index number = 0; number < cells.size(); ++number) {
    const std::span<const Index> cell = cells.cell(number);
    bool any = false;
    for (const Index i : cell) any |= is_member[i] != 0;
    if (!any) continue;
    const double volume = thickness * cell_volume(particles, cell);
    for (const RulePoint& point : dim == 2 ? triangle : tetrahedron) {
      const Vector3 x = place_of(particles, cell, point);
      const Vector3 b = load({x.data(), static_cast<std::size_t>(dim)});
      for (std::size_t c = 0; c < cell.size(); ++c) {
        if (!is_member[cell[c]]) continue;
        for (int a = 0; a < dim; ++a) {
          loads.forces[cell[c] * width + a] += volume * point.weight * point.shape[c] * b[a];
        }
      }
    }
  }
}

}  // namespace perilink
