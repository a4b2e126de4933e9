#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/types.hpp"

/// \file
/// The optimisation behind bond calibration: weights that satisfy linear equations at points and
/// depart as little as possible from one.

namespace perilink {

/// Weights w_v, one per variable, each with an end at two points. At every point p hold `rows`
/// equations
///
///   sum over variables with first end p of a_v w_v
///     + sum over those with second end p of +- a_v w_v = r_p,
///
/// with the sign - in the first `odd` rows (forces, that act against each other at the two ends)
/// and + in the others (moments, moduli). The last row may hold for groups of points instead.
/// Variables from `one_ended` on act in the rows that are not odd at their first end only
/// (couples).
struct PointEquations {
  int dim = 2;
  int rows = 0;
  int odd = 0;
  std::vector<Index> first, second;  ///< points of each variable
  Index one_ended = std::numeric_limits<Index>::max();
  /// Per point: the point at which the last row of its variables counts, summed over the group;
  /// empty: at the point itself.
  std::vector<Index> group;
  /// Per variable: the unknown that it shares with others; where nothing is asked at an end, its
  /// point is no_index. Empty: every variable is an unknown of its own.
  std::vector<Index> unknown;
  std::vector<double> coefficients;  ///< a_v, shape (variables, rows)
  std::vector<double> lower;         ///< least weight of each variable
  std::vector<double> upper;         ///< largest weight of each variable
  std::vector<double> right;         ///< r_p, shape (points, rows)
  /// Per equation, shape (points, rows): times r they are of order one; 0 switches an equation off.
  std::vector<double> scale;
  /// Per row, empty: none. 0: equations hold exactly; > 0: their squared residuals are charged
  /// 1 / ridge against the squared changes of the weights.
  std::vector<double> ridge;
  std::vector<double> positions;  ///< where the points are, shape (points, dim) [length]

  Index num_variables() const { return static_cast<Index>(first.size()); }
  int own_rows() const { return group.empty() ? rows : rows - 1; }
  double ridge_of(std::size_t row) const { return ridge.empty() ? 0.0 : ridge[row]; }
  Index num_points() const {
    return static_cast<Index>(right.size() / static_cast<std::size_t>(rows));
  }
};

/// What speeds up the conjugate gradients.
enum class Preconditioner {
  blocks,              ///< those of the single points: for few points
  factor,              ///< that of all equations: bodies and boundaries in the plane
  blocks_then_boxes,   ///< and the soft fields of boxes where blocks take many iterations: solids
  blocks_then_factor,  ///< the factor where they do: solids with few variables
};

/// How the bounds are met.
enum class Method {
  newton,          ///< Newton's method on the dual function: few steps where few bounds matter
  interior_point,  ///< a few tens of dear steps, whatever the bounds do
};

/// How to solve them.
struct LeastChangeOptions {
  /// For the norm of the scaled residual, per root of the number of points.
  double tolerance = 1e-12;
  int iterations = 20000;  ///< conjugate gradients after which no step begins
  double price = std::numeric_limits<double>::infinity();  ///< on what is left of exact equations
  /// Interior-point method only: part of the multipliers by which equations may be left at first
  /// (interior_point.hpp).
  double proximity = 0.0;
  Preconditioner preconditioner = Preconditioner::blocks;
  Method method = Method::newton;
};

class BoxSpace;
class EquationsFactor;

/// Preconditioners that were made for one problem and serve the next one, too, where points are the
/// same and coefficients similar.
struct KeptPreconditioner {
  std::unique_ptr<BoxSpace> boxes;
  std::unique_ptr<EquationsFactor> factor;

  KeptPreconditioner();
  ~KeptPreconditioner();
  void reset();
};

/// What came out.
struct LeastChange {
  std::vector<double> weights;
  double residual = 0.0;         ///< largest scaled residual of an equation
  Index worst_point = no_index;  ///< where it is
  Index at_lower = 0;            ///< number of weights at their lower bound
  int iterations = 0;            ///< conjugate gradients, in all
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
LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options);

/// The same with a preconditioner that is kept for the next problem and renewed where it serves
/// badly.
LeastChange least_change(const PointEquations& equations, const LeastChangeOptions& options,
                         KeptPreconditioner& kept);

}  // namespace perilink
