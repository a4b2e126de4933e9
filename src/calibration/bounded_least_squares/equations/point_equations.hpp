#pragma once

#include <limits>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Weights w_v, one per variable, each with an end at two points. At every point p hold `rows`
/// equations
///
///   sum over variables with first end p of a_v w_v
///     + sum over variables with second end p of +- a_v w_v = r_p,
///
/// with the sign - in the first `odd` rows (forces, opposite at the two ends) and + in the others
/// (moments, moduli). The last row may hold for groups of points instead. Variables from
/// `one_ended` on act in the rows that are not odd at their first end only (couples).
struct PointEquations {
  int dim = 2;
  int rows = 0;
  int odd = 0;
  /// Whether the coarse space begins with Killing tensors: for unstructured particle sets in space,
  /// with bonds without moments and area fractions. Odd rows are the components of n n n in
  /// ascending order.
  bool killing = false;
  std::vector<Index> first, second;  ///< points of each variable
  Index one_ended = std::numeric_limits<Index>::max();
  /// Per point: the point at which the last row of its variables is summed over the group. Empty:
  /// the point itself.
  std::vector<Index> group;
  /// Per variable: the unknown that it shares with other variables; an end without equations has
  /// the point no_index. Empty: every variable is a separate unknown.
  std::vector<Index> unknown;
  std::vector<double> coefficients;  ///< a_v, shape (variables, rows)
  std::vector<double> lower;         ///< least weight of each variable
  std::vector<double> upper;         ///< largest weight of each variable
  std::vector<double> right;         ///< r_p, shape (points, rows)
  /// Per equation, shape (points, rows): scale times r is of order one; 0 switches an equation off.
  std::vector<double> scale;
  /// Per row. 0 or empty: equations hold exactly. > 0: squared residuals weigh 1 / ridge against
  /// squared changes of the weights.
  std::vector<double> ridge;
  std::vector<double> positions;  ///< positions of the points, shape (points, dim) [length]

  Index num_variables() const { return static_cast<Index>(first.size()); }
  int own_rows() const { return group.empty() ? rows : rows - 1; }
  double ridge_of(std::size_t row) const { return ridge.empty() ? 0.0 : ridge[row]; }
  Index num_points() const {
    return static_cast<Index>(right.size() / static_cast<std::size_t>(rows));
  }
};

/// Preconditioner of the conjugate gradients.
enum class Preconditioner {
  blocks,              ///< blocks of single points: for few points
  factor,              ///< factor of all equations: bodies and boundaries in the plane
  blocks_then_boxes,   ///< blocks, and a coarse space where they take many iterations: solids
  blocks_then_factor,  ///< as blocks_then_boxes with a factor: solids with few variables
};

/// Method for the bounds.
enum class Method {
  newton,          ///< Newton's method on the dual function: few steps where few bounds are active
  interior_point,  ///< a few tens of expensive steps for any bounds
};

/// Options of a solution.
struct LeastSquaresOptions {
  /// Tolerance of the norm of the scaled residual, over the root of the number of points.
  double tolerance = 1e-12;
  int iterations = 20000;  ///< conjugate-gradient iterations after which no step begins
  /// Exact (L1) penalty on residuals of exact equations.
  double penalty = std::numeric_limits<double>::infinity();
  /// Interior-point method only: allowed residual over the multiplier, at first
  /// (interior_point.hpp).
  double regularisation = 0.0;
  /// Interior-point method with a regularisation only: the solution ends where the multipliers show
  /// that an equation will have a larger residual.
  double infeasible_above = std::numeric_limits<double>::infinity();
  /// Newton's method only: equations are infeasible where a step at settled weights leaves more
  /// than this of the residual.
  double infeasible_ratio = 0.9;
  /// Newton's method only: a step has diverged at this multiple of the least residual, and the
  /// solution ends at the least. Multipliers of infeasible equations grow until their weights
  /// violate all other equations.
  double diverged = std::numeric_limits<double>::infinity();
  /// Conjugate gradients keep all directions of a solution, so that residuals of coarse solutions
  /// do not depend on round-off.
  bool keeps_directions = false;
  Preconditioner preconditioner = Preconditioner::blocks;
  Method method = Method::newton;
  /// Newton's method only: multipliers of a similar problem to start from. Empty: zero.
  std::vector<double> start = {};
};

}  // namespace perilink
