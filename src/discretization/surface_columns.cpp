#include "discretization/surface_columns.hpp"

#include <limits>
#include <numeric>

namespace perilink {

std::vector<Index> surface_columns(const Bonds& bonds, const Facets& facets, Index num_particles) {
  std::vector<Index> head(static_cast<std::size_t>(num_particles));
  std::iota(head.begin(), head.end(), 0);
  std::vector<double> distance(head.size(), std::numeric_limits<double>::infinity());
  for (const Index i : facets.corners.values) distance[i] = 0.0;
  const std::vector<double> of_facets = distance;
  for (Index b = 0; b < bonds.size(); ++b) {
    const Index ends[2] = {bonds.first[b], bonds.second[b]};
    for (const int side : {0, 1}) {
      const Index below = ends[side], above = ends[1 - side];
      if (of_facets[above] > 0.0 || bonds.lengths[b] >= distance[below]) continue;
      distance[below] = bonds.lengths[b];
      head[below] = above;
    }
  }
  return head;
}

}  // namespace perilink
