#include "calibration/surface_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace perilink {
namespace {

/// Relative difference of equal distances, and absolute difference of equal components of
/// directions.
constexpr double same_distance = 1e-9, same_component = 1e-6;

/// Order of directions, independent of round-off and of particle numbers.
bool comes_first(const Vector3& a, const Vector3& b) {
  const auto [x, y] = std::ranges::mismatch(
      a, b, [](double p, double q) { return std::abs(p - q) <= same_component; });
  return x != a.end() && *x < *y;
}

}  // namespace

std::vector<Index> surface_columns(const Bonds& bonds, const Facets& facets,
                                   const Particles& particles) {
  std::vector<Index> head(static_cast<std::size_t>(particles.size()));
  std::iota(head.begin(), head.end(), 0);
  std::vector<double> distance(head.size(), std::numeric_limits<double>::infinity());
  const auto mark = [&](bool on_surface, auto&& visit) {
    for (Index f = 0; f < facets.size(); ++f) {
      if (facets.on_surface(f) != on_surface) continue;
      for (Index c = facets.corners.offsets[f]; c < facets.corners.offsets[f + 1]; ++c) {
        visit(facets.corners.values[c]);
      }
    }
  };
  mark(true, [&](Index i) { distance[i] = 0.0; });
  mark(false, [&](Index i) { head[i] = no_index; });
  const std::vector<double> of_surface = distance;
  const auto for_each_below = [&](auto&& visit) {
    for (Index b = 0; b < bonds.size(); ++b) {
      const Index ends[2] = {bonds.first[b], bonds.second[b]};
      for (const int side : {0, 1}) {
        const Index below = ends[side], above = ends[1 - side];
        if (of_surface[above] > 0.0 || of_surface[below] == 0.0) continue;
        if (head[above] == no_index || head[below] == no_index) continue;
        if (particles.material[above] != particles.material[below]) continue;
        visit(b, below, above, side == 0 ? 1.0 : -1.0);
      }
    }
  };
  for_each_below([&](Index b, Index below, Index, double) {
    distance[below] = std::min(distance[below], bonds.length(b));
  });
  // Many particles of meshes are equally far from two surface particles.
  std::vector<Vector3> upwards(head.size());
  for_each_below([&](Index b, Index below, Index above, double sign) {
    if (bonds.length(b) > (1.0 + same_distance) * distance[below]) return;
    Vector3 direction{};
    for (int a = 0; a < bonds.dim; ++a) direction[a] = sign * bonds.direction(b)[a];
    if (head[below] != below && !comes_first(direction, upwards[below])) return;
    head[below] = above;
    upwards[below] = direction;
  });
  return head;
}

}  // namespace perilink
