#include "network/builder/shell_bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace perilink {
namespace {

/// The mid-surface: a plane, or a cylinder with its axis along y that touches the plane at x = 0
/// from below.
struct MiddleSurface {
  double radius;  ///< 0: flat

  Vector3 normal(double x) const {
    if (radius == 0.0) return {0.0, 0.0, 1.0};
    return {std::sin(x / radius), 0.0, std::cos(x / radius)};
  }
  /// Returns the mean height over the chord between two points `around` apart along x [length].
  double rise(double around) const {
    if (radius == 0.0) return 0.0;
    const double half = 0.5 * std::abs(around) / radius;
    if (half < 1e-3) return radius * half * half / 3.0;
    return radius * (std::sin(half) / half - std::cos(half));
  }
};

void refuse_overlap(const Particles& mid_surface, double radius) {
  if (radius == 0.0) return;
  double lower = mid_surface.positions[0], upper = lower;
  for (Index i = 0; i < mid_surface.size(); ++i) {
    lower = std::min(lower, mid_surface.position(i)[0]);
    upper = std::max(upper, mid_surface.position(i)[0]);
  }
  if (upper - lower < 2.0 * std::numbers::pi * radius) return;
  throw std::invalid_argument("the mid-surface is longer than the circumference of its cylinder");
}

/// Returns the particles with a third coordinate of zero.
Particles in_space(const Particles& plane) {
  Particles mid_surface = plane;
  mid_surface.dim = 3;
  mid_surface.positions.clear();
  for (Index i = 0; i < plane.size(); ++i) {
    const auto x = plane.position(i);
    mid_surface.positions.insert(mid_surface.positions.end(), {x[0], x[1], 0.0});
  }
  return mid_surface;
}

/// Returns the out-of-plane shear stiffness of a shell bond over k [-]. Bending of the bond and
/// shear of the material are in series.
double shear_ratio(double poissons_ratio, double length, double thickness) {
  const double of_material = 5.0 * (1.0 - poissons_ratio) / (12.0 * (1.0 + poissons_ratio));
  return 1.0 / (1.0 / of_material + length * length / (thickness * thickness));
}

void turn_facets(const MiddleSurface& surface, const Particles& mid_surface, Facets& facets) {
  std::vector<double> turned;
  for (Index f = 0; f < facets.size(); ++f) {
    double x = 0.0;
    const auto corners = facets.corners.row(f);
    for (const Index i : corners)
      x += mid_surface.position(i)[0] / static_cast<double>(corners.size());
    const auto area = facets.area_vector(f);
    const Vector3 m = surface.normal(x);
    turned.insert(turned.end(), {area[0] * m[2], area[1], -area[0] * m[0]});
  }
  facets.dim = 3;
  facets.area_vectors = std::move(turned);
}

}  // namespace

Vector3 point_on_shell(double x, double y, double radius) {
  if (radius == 0.0) return {x, y, 0.0};
  const double half = std::sin(0.5 * x / radius);
  return {radius * std::sin(x / radius), y, -2.0 * radius * half * half};
}

void make_shell(const NetworkInput& input, Network& network) {
  refuse_overlap(network.particles, input.radius);
  const MiddleSurface surface{input.radius};
  Shell shell{in_space(network.particles), input.thickness, {}, {}, {}};
  const Particles& mid_surface = shell.mid_surface;
  network.particles = mid_surface;
  for (Index i = 0; i < mid_surface.size(); ++i) {
    const auto flat = mid_surface.position(i);
    const Vector3 point = point_on_shell(flat[0], flat[1], input.radius);
    std::copy(point.begin(), point.end(), network.particles.positions.begin() + 3L * i);
  }
  Bonds bonds;
  bonds.dim = 3;
  for (Index e = 0; e < network.bonds.size(); ++e) {
    const Index i = network.bonds.first[e], j = network.bonds.second[e];
    const auto ratio = [&](Index particle) {
      const Index material = mid_surface.material[particle];
      return input.materials[material].poissons_ratio;
    };
    bonds.append(network.particles, i, j);
    const double from = mid_surface.position(i)[0], to = mid_surface.position(j)[0];
    const Vector3 normal = surface.normal(0.5 * (from + to));
    shell.normals.insert(shell.normals.end(), normal.begin(), normal.end());
    shell.rise.push_back(surface.rise(to - from));
    shell.shear_ratio.push_back(
        shear_ratio(0.5 * (ratio(i) + ratio(j)), bonds.length(e), input.thickness));
  }
  network.bonds = std::move(bonds);
  turn_facets(surface, mid_surface, network.facets);
  network.shell = std::move(shell);
}

}  // namespace perilink
