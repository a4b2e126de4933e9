#include "calibration/surface_columns.hpp"

#include <limits>
#include <numeric>

namespace perilink {

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
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index ends[2] = {bonds.first[b], bonds.second[b]};
    for (const int side : {0, 1}) {
      const Index below = ends[side], above = ends[1 - side];
      if (of_surface[above] > 0.0 || bonds.length(b) >= distance[below]) continue;
      if (head[above] == no_index || head[below] == no_index) continue;
      if (particles.material[above] != particles.material[below]) continue;
      distance[below] = bonds.length(b);
      head[below] = above;
    }
  }
  return head;
}

}  // namespace perilink
