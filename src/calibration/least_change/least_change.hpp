#pragma once

#include <vector>

#include "base/types.hpp"
#include "calibration/least_change/equations/point_equations.hpp"
#include "calibration/least_change/kept_preconditioner.hpp"

/// \file
/// The optimisation behind bond calibration: weights that satisfy linear equations at points and
/// depart as little as possible from one.

namespace perilink {

/// What came out.
struct LeastChange {
  std::vector<double> weights;
  double residual = 0.0;            ///< largest scaled residual of an equation
  Index worst_point = no_index;     ///< where it is
  Index at_lower = 0;               ///< number of weights at their lower bound
  int iterations = 0;               ///< conjugate gradients, in all
  double operations = 0.0;          ///< tied variables only
  std::vector<double> multipliers;  ///< by Newton's method
  /// False: no weights within the bounds satisfy all equations, or too few iterations; what can be
  /// met is met.
  bool converged = false;
};

/// Minimises sum (w_v - 1)^2 subject to the equations and the bounds. The bounded problem is
/// solved, not clamped: Newton's method on the concave dual function, w(y) = min(max(1 + A' y,
/// lower), upper) with A w(y) + ridge y = r, whose linear systems A D A' (D: the weights between
/// the bounds) conjugate gradients solve, or the interior-point method (interior_point.hpp).
/// Where exact equations contradict each other or the bounds, and have a price, what is left of
/// each (scaled) is charged with its size times the price: few equations are given up, the others
/// hold exactly, with multipliers below the price. Without a price the steps, which are those of
/// the method of multipliers, lead to the least squared residual. Newton's method may get lost on
/// the way.
/// \throws std::invalid_argument for numbers of rows, odd ones and groups that are not built in
LeastChange least_change(PointEquations equations, const LeastChangeOptions& options);

/// The same with a preconditioner that is kept for the next problem and renewed where it serves
/// badly.
LeastChange least_change(PointEquations equations, const LeastChangeOptions& options,
                         KeptPreconditioner& kept);

}  // namespace perilink
