#pragma once

#include <vector>

#include <Eigen/Core>

#include "calibration/least_change/variable_parts.hpp"

namespace perilink::test {

/// (A D A' + diagonal) x of the scaled equations, written out.
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

}  // namespace perilink::test
