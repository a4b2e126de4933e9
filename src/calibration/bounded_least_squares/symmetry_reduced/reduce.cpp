#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include "base/csr.hpp"
#include "calibration/bounded_least_squares/equations/variable_parts.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/independent_rows.hpp"

namespace perilink {
namespace {

/// Least number of rows for the removal of dependent rows. Smaller systems have cheap factors. With
/// removal, a strip of one row of cells took 121 iterations, more than its test allows.
constexpr std::size_t dear = 2000;

/// Returns the variables at each point.
Csr variables_at_points(const PointEquations& equations) {
  return sorted_into_rows(equations.num_points(), [&](auto act) {
    for (Index v = 0; v < equations.num_variables(); ++v) {
      Index last = no_index;
      for_each_part(equations, v, [&](Index p, int, int, double) {
        if (p != no_index && p != last) act(p, v);
        last = p;
      });
    }
  });
}

/// \param variables  variables at the point
PointRows rows_of_point(const PointEquations& equations, const ReducedEquations& reduced,
                        Index point, std::span<const Index> variables) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows), first = point * rows;
  PointRows own;
  for (const Index v : variables) own.columns.push_back(reduced.unknown_of[v]);
  std::ranges::sort(own.columns);
  own.columns.erase(std::unique(own.columns.begin(), own.columns.end()), own.columns.end());
  own.values.setZero(equations.rows, static_cast<Eigen::Index>(own.columns.size()));
  own.right = Eigen::Map<const Eigen::VectorXd>(equations.right.data() + first, equations.rows);
  for (const Index v : variables) {
    const double root = reduced.root[reduced.unknown_of[v]];
    const double* a = equations.coefficients.data() + v * rows;
    const auto found = std::ranges::lower_bound(own.columns, reduced.unknown_of[v]);
    auto column = own.values.col(found - own.columns.begin());
    for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
      if (p != point) return;
      for (int r = from; r < to; ++r) {
        column[r] += sign * a[r] / root;
        own.right[r] += sign * a[r] / root - sign * a[r];
      }
    });
  }
  const Eigen::Map<const Eigen::VectorXd> scale(equations.scale.data() + first, equations.rows);
  own.values.array().colwise() *= scale.array();
  own.right.array() *= scale.array();
  return own;
}

/// Appends the nonzero entries.
void append(const PointRows& own, Index first, ReducedEquations& reduced) {
  for (Eigen::Index r = 0; r < own.values.rows(); ++r) {
    reduced.matrix.startVec(first + r);
    for (std::size_t k = 0; k < own.columns.size(); ++k) {
      const double value = own.values(r, static_cast<Eigen::Index>(k));
      if (value != 0.0) reduced.matrix.insertBack(first + r, own.columns[k]) = value;
    }
    reduced.equations.right.push_back(own.right[r]);
  }
}

/// Numbers the unknowns and sets their bounds.
void number_unknowns(const PointEquations& equations, ReducedEquations& reduced) {
  std::unordered_map<Index, Index> numbers;
  for (const Index name : equations.unknown) {
    const Index u = numbers.emplace(name, static_cast<Index>(numbers.size())).first->second;
    reduced.unknown_of.push_back(u);
    reduced.root.resize(numbers.size(), 0.0);
    reduced.root[u] += 1.0;
  }
  for (double& root : reduced.root) root = std::sqrt(root);
  reduced.equations.lower.resize(reduced.root.size());
  reduced.equations.upper.resize(reduced.root.size());
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const Index u = reduced.unknown_of[v];
    reduced.equations.lower[u] = 1.0 + reduced.root[u] * (equations.lower[v] - 1.0);
    reduced.equations.upper[u] = 1.0 + reduced.root[u] * (equations.upper[v] - 1.0);
  }
}

}  // namespace

ReducedEquations reduce(const PointEquations& equations, IndependentRows& kept) {
  ReducedEquations reduced;
  reduced.equations.dim = equations.dim;
  reduced.equations.rows = equations.rows;
  reduced.equations.odd = equations.odd;
  reduced.equations.ridge = equations.ridge;
  reduced.equations.scale.assign(equations.scale.size(), 1.0);
  number_unknowns(equations, reduced);
  // Not with couples: the solution for a wall of one cell ended in round-off, at 2e-9 of the
  // forces.
  const bool turns = equations.one_ended >= equations.num_variables();
  const Index num_points = equations.num_points();
  if (turns) kept.bases.resize(static_cast<std::size_t>(num_points));
  reduced.matrix.resize(static_cast<Eigen::Index>(equations.right.size()),
                        static_cast<Eigen::Index>(reduced.root.size()));
  const Csr variables = variables_at_points(equations);
  for (Index p = 0; p < num_points; ++p) {
    PointRows own = rows_of_point(equations, reduced, p, variables.row(p));
    if (turns) turn_rows(own, kept.bases[p]);
    append(own, p * equations.rows, reduced);
  }
  reduced.matrix.finalize();
  reduced.independent = turns && equations.right.size() >= dear;
  if (reduced.independent) leave_out_implied(reduced, kept.implied);
  return reduced;
}

}  // namespace perilink
