#include "network/lattice_pattern.hpp"

#include "discretization/bonds.hpp"

namespace perilink {
namespace {

/// Depth of distinct places under a face, over the reach of bonds.
constexpr Index counted_reaches = 3;

}  // namespace

GridPoint LatticePattern::place(const GridPoint& point) const {
  GridPoint like = point;
  for (int a = 0; a < 3; ++a) {
    const Index above = grid.count[a] - point[a];
    if (small.count[a] == grid.count[a] || point[a] < depth[a]) continue;
    // The middle has two places: points of a face-centred lattice are even or odd.
    like[a] = above < depth[a] ? small.count[a] - above : depth[a] + (point[a] - depth[a]) % 2;
  }
  return like;
}

double LatticePattern::num_bonds() const {
  std::array<std::vector<double>, 3> times;  // occurrences of each template plane in the box
  for (int a = 0; a < 3; ++a) {
    times[a].assign(static_cast<std::size_t>(small.count[a]) + 1, 0.0);
    GridPoint point{};
    for (point[a] = 0; point[a] <= grid.count[a]; ++point[a]) times[a][place(point)[a]] += 1.0;
  }
  double bonds = 0.0;
  std::vector<double> starting(static_cast<std::size_t>(sample.particles.size()), 0.0);
  for (const Index i : sample.bonds.first) starting[i] += 1.0;
  std::size_t i = 0;
  small.for_each(small.all(), [&](const GridPoint& p) {
    bonds += starting[i++] * times[0][p[0]] * times[1][p[1]] * times[2][p[2]];
  });
  return bonds;
}

LatticePattern pattern_of(const LatticeGrid& grid, double horizon) {
  LatticePattern pattern;
  pattern.grid = pattern.small = grid;
  for (int a = 0; a < grid.dim; ++a) {
    pattern.reach[a] = static_cast<Index>(horizon * (1.0 + horizon_tolerance) / grid.step[a]);
    pattern.depth[a] = counted_reaches * pattern.reach[a];
    const Index enough = 2 * pattern.depth[a] + 2 + grid.count[a] % 2;
    if (grid.count[a] <= enough) continue;
    pattern.small.count[a] = enough;
    pattern.small.upper[a] = grid.lower[a] + grid.step[a] * enough;
  }
  return pattern;
}

PatternBonds::PatternBonds(const LatticePattern& pattern)
    : pattern_(pattern),
      neighbourhoods_(bonds_of_particles(pattern.sample.bonds, pattern.sample.particles.size())) {
  pattern.small.for_each(pattern.small.all(),
                         [&](const GridPoint& point) { points_.push_back(point); });
}

}  // namespace perilink
