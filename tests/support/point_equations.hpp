#pragma once

#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "calibration/bounded_least_squares/equations/variable_parts.hpp"

namespace perilink::test {

/// Returns (A D A' + diagonal) x of the scaled equations, by definition.
inline Eigen::VectorXd apply_system(const PointEquations& equations,
                                    const std::vector<double>& active, double diagonal,
                                    const Eigen::VectorXd& x) {
  Eigen::VectorXd result = diagonal * x;
  for (Index v = 0; v < equations.num_variables(); ++v) {
    const auto for_each_entry = [&](auto visit) {
      for_each_part(equations, v, [&](Index p, int from, int to, double sign) {
        for (int r = from; r < to; ++r) {
          const Index k = p * equations.rows + r;
          visit(k, sign * equations.coefficients[v * equations.rows + r] * equations.scale[k]);
        }
      });
    };
    double stretch = 0.0;
    for_each_entry([&](Index k, double value) { stretch += value * x[k]; });
    for_each_entry([&](Index k, double value) { result[k] += active[v] * stretch * value; });
  }
  return result;
}

/// Returns random variables between points in space, every sixth at a bound. The last five act at
/// one end only in the rows that are not odd.
/// \param grouped        the last row holds for groups of points
/// \param active_weight  of the variables, appended
inline PointEquations random_equations(Index points, int rows, int odd, bool grouped,
                                       std::vector<double>& active_weight) {
  std::mt19937 random(5);  // fixed: the same equations in every run
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  PointEquations equations;
  equations.dim = 3;
  equations.rows = rows;
  equations.odd = odd;
  equations.right.assign(static_cast<std::size_t>(points * rows), 0.0);
  for (std::size_t k = 0; k < equations.right.size(); ++k) {
    equations.scale.push_back(1.0 + number());
  }
  for (Index k = 0; k < 3 * points; ++k) equations.positions.push_back(number());
  for (Index p = 0; grouped && p < points; ++p) equations.group.push_back(p % 3 == 0 ? p : p / 2);
  const Index variables = 12 * points;
  for (Index v = 0; v < variables; ++v) {
    equations.first.push_back(v % points);
    equations.second.push_back((v + 1 + v % 5) % points);
    active_weight.push_back(v % 6 == 0 ? 0.0 : 0.5 + number());
    for (int r = 0; r < rows; ++r) equations.coefficients.push_back(number());
  }
  equations.one_ended = variables - 5;
  return equations;
}

/// Returns equations of one point with two weights.
inline PointEquations two_weights(std::vector<double> coefficients, std::vector<double> right) {
  PointEquations equations;
  equations.rows = static_cast<int>(right.size());
  equations.first = {0, 0};
  equations.second = {no_index, no_index};
  equations.unknown = {0, 1};
  equations.coefficients = std::move(coefficients);
  equations.lower.assign(2, 0.0);
  equations.upper.assign(2, 10.0);
  equations.scale.assign(right.size(), 1.0);
  equations.right = std::move(right);
  equations.positions = {0.0, 0.0};
  return equations;
}

}  // namespace perilink::test
