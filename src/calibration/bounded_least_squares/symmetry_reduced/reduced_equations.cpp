#include "calibration/bounded_least_squares/symmetry_reduced/reduced_equations.hpp"

#include <algorithm>

#include "base/csr.hpp"

namespace perilink {

std::vector<double> ReducedEquations::weights(std::span<const double> unknowns) const {
  std::vector<double> result;
  result.reserve(unknown_of.size());
  for (const Index u : unknown_of) result.push_back(1.0 + (unknowns[u] - 1.0) / root[u]);
  return result;
}

std::vector<std::pair<Index, Index>> shared_variables(const ReducedEquations::Matrix& columns,
                                                      Index rows) {
  std::vector<Index> points;
  Csr later = sorted_into_rows(static_cast<Index>(columns.cols()) / rows, [&](auto act) {
    for (Index u = 0; u < static_cast<Index>(columns.rows()); ++u) {
      points.clear();
      for_each_point(columns, u, rows, [&](int first, int) {
        points.push_back(columns.innerIndexPtr()[first] / rows);
        for (const Index p : points) act(p, points.back());
      });
    }
  });
  std::vector<std::pair<Index, Index>> pairs(later.values.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (Index p = 0; p < later.rows(); ++p) {
    const auto begin = later.values.begin() + later.offsets[p];
    std::sort(begin, later.values.begin() + later.offsets[p + 1]);
    for (Index k = later.offsets[p]; k < later.offsets[p + 1]; ++k) pairs[k] = {p, later.values[k]};
  }
  return pairs;
}

}  // namespace perilink
