#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "calibration/least_change/equations/variable_parts.hpp"

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
