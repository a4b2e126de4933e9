#pragma once

#include <vector>

#include "base/types.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/bounded_least_squares/kept_preconditioner.hpp"

/// \file The optimisation of bond calibration: weights that satisfy linear equations at points and
///     differ as little as possible from one.

namespace perilink {

/// Weights and how the solution ended.
struct LeastSquaresResult {
  std::vector<double> weights;
  double residual = 0.0;            ///< largest scaled residual of an equation
  Index worst_point = no_index;     ///< point of the largest residual
  Index at_lower = 0;               ///< number of weights at their lower bound
  int iterations = 0;               ///< total of conjugate-gradient iterations
  std::vector<double> multipliers;  ///< by Newton's method
  /// False: no weights within the bounds satisfy all equations, or too few iterations were allowed.
  bool converged = false;
  /// Steps of the interior-point method stayed short: the equations seem far from feasible.
  bool stalled = false;
};

/// Minimises sum (w_v - 1)^2 subject to the equations and the bounds. Newton's method maximises the
/// concave dual function, w(y) = min(max(1 + A' y, lower), upper) with A w(y) + ridge y = r.
/// Conjugate gradients solve its linear systems A D A' (D: the weights between the bounds). The
/// alternative is an interior-point method (interior_point.hpp).
///
/// Exact equations may have an exact (L1) penalty on their scaled residuals. Then few infeasible
/// equations are relaxed, the others hold exactly, and multipliers stay below the penalty. Without
/// a penalty the method of multipliers leads to the least squared residual, but Newton's method may
/// diverge.
/// \throws std::invalid_argument for numbers of rows, odd ones and groups that are not built in
LeastSquaresResult bounded_least_squares(PointEquations equations,
                                         const LeastSquaresOptions& options);

/// Minimises with a preconditioner that is kept for the next problem and renewed when it needs too
/// many iterations.
LeastSquaresResult bounded_least_squares(PointEquations equations,
                                         const LeastSquaresOptions& options,
                                         KeptPreconditioner& kept);

}  // namespace perilink
