#include "calibration/least_change/tied/tied_equations.hpp"

#include <algorithm>

namespace perilink {

std::vector<double> TiedEquations::weights(std::span<const double> unknowns) const {
  std::vector<double> result;
  result.reserve(unknown_of.size());
  for (const Index u : unknown_of) result.push_back(1.0 + (unknowns[u] - 1.0) / root[u]);
  return result;
}

std::vector<std::pair<Index, Index>> shared_variables(const TiedEquations::Matrix& columns,
                                                      Index rows) {
  std::vector<std::pair<Index, Index>> pairs;
  std::vector<Index> points;
  for (Index u = 0; u < static_cast<Index>(columns.rows()); ++u) {
    points.clear();
    for_each_point(columns, u, rows, [&](int first, int) {
      points.push_back(columns.innerIndexPtr()[first] / rows);
      for (const Index p : points) pairs.emplace_back(p, points.back());
    });
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace perilink
