#include "calibration/least_change/tied/tie.hpp"

#include <cmath>
#include <unordered_map>

#include "calibration/least_change/equations/variable_parts.hpp"
#include "calibration/least_change/tied/independent_rows.hpp"

namespace perilink {
namespace {

/// Rows are left out of systems of so many. Smaller ones have cheap factors, and without such rows
/// the search for a strip of one row of cells took 121 iterations, more than its test allows.
constexpr std::size_t dear = 2000;

}  // namespace

TiedEquations tie(const PointEquations& equations, TiedRows& kept) {
  TiedEquations tied;
  PointEquations& small = tied.equations;
  small.dim = equations.dim;
  small.rows = equations.rows;
  small.odd = equations.odd;
  small.right = equations.right;
  small.scale = equations.scale;
  small.ridge = equations.ridge;
  std::unordered_map<Index, Index> numbers;
  for (const Index name : equations.unknown) {
    const Index u = numbers.emplace(name, static_cast<Index>(numbers.size())).first->second;
    tied.unknown_of.push_back(u);
    tied.root.resize(numbers.size(), 0.0);
    tied.root[u] += 1.0;
  }
  for (double& root : tied.root) root = std::sqrt(root);
  small.lower.resize(tied.root.size());
  small.upper.resize(tied.root.size());
  std::vector<Eigen::Triplet<double>> entries;
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  entries.reserve(2 * rows * tied.unknown_of.size());
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const Index u = tied.unknown_of[v];
    const double root = tied.root[u];
    small.lower[u] = 1.0 + root * (equations.lower[v] - 1.0);
    small.upper[u] = 1.0 + root * (equations.upper[v] - 1.0);
    const double* a = equations.coefficients.data() + v * rows;
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      if (p == no_index) return;
      for (int r = from; r < to; ++r) {
        const std::size_t row = p * rows + r;
        const double value = sign * a[r];
        entries.emplace_back(static_cast<int>(row), u, equations.scale[row] * value / root);
        small.right[row] += value / root - value;
      }
    });
  }
  tied.matrix.resize(static_cast<Eigen::Index>(small.right.size()),
                     static_cast<Eigen::Index>(tied.root.size()));
  tied.matrix.setFromTriplets(entries.begin(), entries.end());
  // With couples the search for a wall of one cell ended in round-off, at 2e-9 of the forces.
  if (equations.one_ended >= equations.num_variables()) {
    turn_rows(tied, kept.bases);
    tied.independent = tied.equations.right.size() >= dear;
    if (tied.independent) leave_out_implied(tied, kept.implied);
  }
  return tied;
}

}  // namespace perilink
