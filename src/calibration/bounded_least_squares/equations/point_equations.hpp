#pragma once

#include <limits>
#include <vector>

#include "base/types.hpp"

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
  /// Whether the coarse space begins with Killing tensors: unstructured particle sets in space, of
  /// bonds without moments and shares of facets. Odd rows are the components of n n n in ascending
  /// order.
  bool killing = false;
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

/// Preconditioner of the conjugate gradients.
enum class Preconditioner {
  blocks,              ///< those of the single points: for few points
  factor,              ///< that of all equations: bodies and boundaries in the plane
  blocks_then_boxes,   ///< and a coarse space where blocks take many iterations: solids
  blocks_then_factor,  ///< the factor where they do: solids with few variables
};

/// How the bounds are met.
enum class Method {
  newton,          ///< Newton's method on the dual function: few steps where few bounds matter
  interior_point,  ///< a few tens of dear steps, whatever the bounds do
};

/// How to solve them.
struct LeastSquaresOptions {
  /// For the norm of the scaled residual, per root of the number of points.
  double tolerance = 1e-12;
  int iterations = 20000;  ///< conjugate gradients after which no step begins
  double penalty = std::numeric_limits<double>::infinity();  ///< on residuals of exact equations
  /// Interior-point method only: part of the multipliers by which equations may be left at first
  /// (interior_point.hpp).
  double regularisation = 0.0;
  /// Interior-point method with a regularisation only: the solution ends where the multipliers show
  /// that an equation will have a larger residual.
  double infeasible_above = std::numeric_limits<double>::infinity();
  /// Newton's method only: a step at settled weights that leaves more than this of the residual
  /// leaves infeasible equations.
  double infeasible_ratio = 0.9;
  /// Newton's method only: a step that leaves so many times the least residual so far has diverged,
  /// and the solution ends at the least. Multipliers of infeasible equations grow until the weights
  /// that belong to them violate all other equations.
  double diverged = std::numeric_limits<double>::infinity();
  /// Conjugate gradients keep all directions of a solution, so that residuals of equations that are
  /// solved to few digits do not depend on round-off.
  bool keeps_directions = false;
  Preconditioner preconditioner = Preconditioner::blocks;
  Method method = Method::newton;
  /// Newton's method only: multipliers to start from, of nearly the same problem. Empty: none.
  std::vector<double> start = {};
};

}  // namespace perilink
