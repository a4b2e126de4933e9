#include "network/lattice_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "base/joined_parts.hpp"
#include "network/unknowns.hpp"

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
  double bonds = -num_cut;
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

bool can_repeat(const Network& sample) {
  const bool alike = !sample.calibration || sample.calibration->alike;
  const bool bonds = sample.hinged.empty() && !sample.has_states() && !sample.cells &&
                     sample.first_slip_spring == sample.num_elements();
  const std::vector<std::uint8_t> turning = rotating_particles(sample);
  const bool turn =
      std::all_of(turning.begin(), turning.end(), [](auto flag) { return flag != 0; });
  const Index particles = sample.particles.size();
  const std::vector<Index> parts = connected_parts(sample.bonds, particles);
  const auto loose = loosely_held(sample.bonds, particles, sample.stiffness);
  const auto any = [](const auto& flags) {
    return std::any_of(flags.begin(), flags.end(), [](auto flag) { return flag != 0; });
  };
  return alike && bonds && turn && !any(parts) && !any(loose);
}

bool cut_bonds(LatticePattern& pattern, const std::vector<Crack>& cracks,
               std::vector<Index>& by_crack) {
  pattern.cracks = cracks;
  by_crack.assign(cracks.size(), 0);
  if (cracks.empty()) return true;
  const PatternBonds bonds(pattern);
  const LatticeGrid& grid = pattern.grid;
  const GridWindow around = bonds.around_cracks(), known = grid.grown(around, pattern.reach);
  JoinedParts parts(grid.size(known));
  std::vector<std::array<GridPoint, 2>> lost;
  std::set<GridPoint> ends;
  bonds.for_each_before(around, [&](const GridPoint& first, const GridPoint& second, Index) {
    if (bonds.is_cut(first, second, by_crack)) {
      lost.push_back({first, second});
      ends.insert({first, second});
    } else {
      parts.join(grid.number(known, first), grid.number(known, second));
    }
  });
  pattern.num_cut = static_cast<double>(lost.size());
  const auto part = [&](const GridPoint& point) { return parts.find(grid.number(known, point)); };
  return std::all_of(lost.begin(), lost.end(),
                     [&](const auto& bond) { return part(bond[0]) == part(bond[1]); }) &&
         std::none_of(ends.begin(), ends.end(),
                      [&](const GridPoint& point) { return bonds.is_loose(point); });
}

PatternBonds::PatternBonds(const LatticePattern& pattern)
    : pattern_(pattern),
      neighbourhoods_(bonds_of_particles(pattern.sample.bonds, pattern.sample.particles.size())),
      cutter_(pattern.cracks, pattern.grid.dim, pattern.grid.spacing) {
  pattern.small.for_each(pattern.small.all(),
                         [&](const GridPoint& point) { points_.push_back(point); });
}

bool PatternBonds::is_loose(const GridPoint& point) const {
  Bonds bonds;  // all to one other end: only directions matter
  bonds.dim = pattern_.grid.dim;
  const Network& sample = pattern_.sample;
  bool turns = !sample.carries_moments();
  for_each_of(point, [&](const GridPoint& other, Index element, bool comes_first) {
    if (comes_first ? is_cut(point, other) : is_cut(other, point)) return;
    bonds.append(0, 1, sample.bonds.length(element), sample.bonds.direction(element));
    turns = turns || sample.bending[element] > 0.0;
  });
  return !turns || loosely_held(bonds, 2).front() != 0;
}

GridWindow PatternBonds::around_cracks() const {
  const LatticeGrid& grid = pattern_.grid;
  GridWindow around;
  for (int a = 0; a < grid.dim; ++a) {
    const auto step = [&](double x) {
      return std::clamp((x - grid.lower[a]) / grid.step[a], 0.0, 1.0 * grid.count[a]);
    };
    around.first[a] = static_cast<Index>(std::floor(step(cutter_.lower()[a])));
    around.last[a] = static_cast<Index>(std::ceil(step(cutter_.upper()[a])));
  }
  return grid.grown(around, pattern_.reach);
}

Index PatternBonds::element_between(const GridPoint& first, const GridPoint& second) const {
  Index element = no_index;
  for_each_of(first, [&](const GridPoint& other, Index e, bool comes_first) {
    if (comes_first && other == second) element = e;
  });
  return element;
}

}  // namespace perilink
