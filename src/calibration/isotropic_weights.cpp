#include "calibration/isotropic_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "calibration/bounded_least_squares/bounded_least_squares.hpp"

namespace perilink {
namespace {

/// Returns the index of the opposite of every offset. Offsets of a lattice are in opposite pairs:
/// sorted by coordinates, the first is opposite to the last, and so on.
std::vector<std::size_t> opposites(std::span<const Vector3> offsets) {
  double shortest = 1e300;
  for (const Vector3& offset : offsets) {
    shortest = std::min(shortest, std::hypot(offset[0], offset[1], offset[2]));
  }
  std::vector<std::array<std::int64_t, 3>> places;  // without round-off
  for (const Vector3& offset : offsets) {
    auto& place = places.emplace_back();
    for (int a = 0; a < 3; ++a) place[a] = std::llround(1e6 * offset[a] / shortest);
  }
  std::vector<std::size_t> order(offsets.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t k, std::size_t m) { return places[k] < places[m]; });
  std::vector<std::size_t> opposite(offsets.size());
  for (std::size_t k = 0; k < order.size(); ++k) opposite[order[k]] = order[order.size() - 1 - k];
  return opposite;
}

struct Ray {
  double length;
  Vector3 direction;
};

Ray ray_of(const Vector3& offset) {
  const double length = std::hypot(offset[0], offset[1], offset[2]);
  return {length, {offset[0] / length, offset[1] / length, offset[2] / length}};
}

}  // namespace

double partial_volume(double length, double horizon, double spacing) {
  return std::clamp((horizon + 0.5 * spacing - length) / spacing, 0.0, 1.0);
}

void make_isotropic(int dim, std::span<const Vector3> offsets, double volume,
                    const LameConstants& constants, NeighbourhoodStiffness& stiffness) {
  const bool bending = !stiffness.bending.empty();
  const ModuliRows rows{dim, bending};
  const std::vector<std::size_t> opposite = opposites(offsets);
  PointEquations equations;
  equations.dim = dim;
  equations.rows = rows.count();
  equations.positions.assign(static_cast<std::size_t>(dim), 0.0);
  std::vector<double> row(static_cast<std::size_t>(rows.count()));
  std::vector<std::size_t> offset_of;  // per variable: one offset of an opposite pair
  double modulus = 0.0;
  for (const bool shear : {false, true}) {
    if (shear && !bending) break;
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      if (opposite[k] < k) continue;
      const Ray ray = ray_of(offsets[k]);
      const std::span<const double> direction(ray.direction.data(), static_cast<std::size_t>(dim));
      const double start = shear ? stiffness.bending[k] : stiffness.axial[k];
      if (shear) {
        rows.shear(ray.length, direction, row.data());
      } else {
        rows.axial(ray.length, direction, row.data());
        modulus += start * ray.length * ray.length;
      }
      for (const double value : row) equations.coefficients.push_back(start * value);
      equations.first.push_back(0);
      equations.second.push_back(0);  // a pair acts twice on the particle
      equations.lower.push_back(1e-3);
      equations.upper.push_back(100.0);
      offset_of.push_back(k);
    }
  }
  equations.right.resize(row.size());
  rows.right(volume, constants, equations.right.data());
  equations.scale.assign(row.size(), 1.0 / modulus);
  LeastSquaresOptions options;
  options.tolerance = 1e-14;
  const LeastSquaresResult change = bounded_least_squares(equations, options);
  if (change.residual > 1e-12) {
    throw std::invalid_argument(
        "the neighbours within the horizon are too few, or too one-sided, for an isotropic solid");
  }
  for (std::size_t v = 0; v < offset_of.size(); ++v) {
    const bool shear = bending && v >= offset_of.size() / 2;
    std::vector<double>& values = shear ? stiffness.bending : stiffness.axial;
    const double value = values[offset_of[v]] * change.weights[v];
    values[offset_of[v]] = values[opposite[offset_of[v]]] = value;
  }
}

}  // namespace perilink
