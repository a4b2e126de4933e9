#include "discretization/cuts/bonds_across_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "discretization/outline.hpp"

namespace perilink {
namespace {

/// Range of cells along one axis that contain a coordinate; two if it lies on their common plane.
struct CellRange {
  Index first, last;
};

CellRange cells_at(const std::vector<double>& cuts, double x, double tolerance) {
  const auto lower = std::lower_bound(cuts.begin(), cuts.end(), x - tolerance);
  const auto upper = std::upper_bound(cuts.begin(), cuts.end(), x + tolerance);
  return {static_cast<Index>(lower - cuts.begin()) - 1,
          static_cast<Index>(upper - cuts.begin()) - 1};
}

/// Returns whether a cell of the union contains the point or touches it.
bool is_inside(const Outline& outline, const Vector3& x, double tolerance) {
  CellRange range[3] = {{0, 0}, {0, 0}, {0, 0}};
  for (int a = 0; a < outline.dim; ++a) range[a] = cells_at(outline.cuts[a], x[a], tolerance);
  for (Index k = range[2].first; k <= range[2].last; ++k) {
    for (Index j = range[1].first; j <= range[1].last; ++j) {
      for (Index i = range[0].first; i <= range[0].last; ++i) {
        if (outline.cell(i, j, k)) return true;
      }
    }
  }
  return false;
}

/// Returns whether a bond stays inside. The bond stays in one cell between two planes of the grid,
/// so the midpoints decide.
/// \param stations  buffer for the crossings with planes
bool stays_inside(const Outline& outline, std::span<const double> from, std::span<const double> to,
                  double tolerance, std::vector<double>& stations) {
  stations.assign({0.0, 1.0});
  for (int a = 0; a < outline.dim; ++a) {
    for (const double cut : outline.cuts[a]) {
      if ((from[a] - cut) * (to[a] - cut) >= 0.0) continue;
      stations.push_back((cut - from[a]) / (to[a] - from[a]));
    }
  }
  std::sort(stations.begin(), stations.end());
  for (std::size_t s = 0; s + 1 < stations.size(); ++s) {
    const double middle = 0.5 * (stations[s] + stations[s + 1]);
    Vector3 x{};
    for (int a = 0; a < outline.dim; ++a) x[a] = from[a] + middle * (to[a] - from[a]);
    if (!is_inside(outline, x, tolerance)) return false;
  }
  return true;
}

}  // namespace

Index remove_bonds_across_gaps(const Particles& particles, Bonds& bonds, std::span<const Box> solid,
                               double tolerance) {
  if (solid.size() < 2) return 0;
  const Outline outline = make_outline(solid, particles.dim, tolerance);
  const auto full = [](std::uint8_t cell) { return cell != 0; };
  if (std::all_of(outline.occupied.begin(), outline.occupied.end(), full)) return 0;
  std::vector<std::uint8_t> keep;
  std::vector<double> stations;
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.first[b], j = bonds.second[b];
    const bool both_solid =
        particles.kind[i] == ParticleKind::solid && particles.kind[j] == ParticleKind::solid;
    keep.push_back(!both_solid || stays_inside(outline, particles.position(i),
                                               particles.position(j), tolerance, stations));
  }
  return keep_bonds(bonds, keep);
}

}  // namespace perilink
