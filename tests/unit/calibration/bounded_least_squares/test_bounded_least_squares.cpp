#include "calibration/bounded_least_squares/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace perilink {
namespace {

double random_number(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0 - 0.5;
}

/// A ring of points, each tied to the next ones; right sides from weights near one.
PointEquations ring(Index points, int rows, int odd, std::vector<double>& weights,
                    Index neighbours = 3) {
  std::mt19937 random(3);
  PointEquations equations;
  equations.rows = rows;
  equations.odd = odd;
  equations.right.assign(static_cast<std::size_t>(points) * rows, 0.0);
  equations.scale.assign(equations.right.size(), 0.5);
  weights.clear();
  for (Index p = 0; p < points; ++p) {
    const double angle = 6.283185307179586 * p / points;
    equations.positions.push_back(std::cos(angle));
    equations.positions.push_back(std::sin(angle));
    for (Index k = 1; k <= neighbours; ++k) {
      equations.first.push_back(p);
      equations.second.push_back((p + k) % points);
      equations.lower.push_back(0.1);
      equations.upper.push_back(100.0);
      weights.push_back(1.0 + 0.3 * random_number(random));
      for (int r = 0; r < rows; ++r) {
        const double a = random_number(random);
        equations.coefficients.push_back(a);
        equations.right[static_cast<std::size_t>(p) * rows + r] += a * weights.back();
        equations.right[static_cast<std::size_t>((p + k) % points) * rows + r] +=
            (r < odd ? -a : a) * weights.back();
      }
    }
  }
  return equations;
}

/// Squares of the changes.
double change_of(const std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights) sum += (w - 1.0) * (w - 1.0);
  return sum;
}

/// Shape (points, rows).
std::vector<double> residuals(const PointEquations& equations, const std::vector<double>& weights) {
  std::vector<double> rest = equations.right;
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (Index v = 0; v < equations.num_variables(); ++v) {
    for (std::size_t r = 0; r < rows; ++r) {
      const double term = equations.coefficients[v * rows + r] * weights[v];
      rest[equations.first[v] * rows + r] -= term;
      if (static_cast<int>(r) < equations.odd) {
        rest[equations.second[v] * rows + r] += term;
      } else if (v < equations.one_ended) {
        rest[equations.second[v] * rows + r] -= term;
      }
    }
  }
  return rest;
}

double largest_residual(const PointEquations& equations, const std::vector<double>& weights) {
  double largest = 0.0;
  for (const double value : residuals(equations, weights)) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Three variables, four equations per point: only the weights that made the right sides fit.
TEST(BoundedLeastSquares, FindsTheOnlyWeightsThatFit) {
  std::vector<double> weights;
  const PointEquations equations = ring(50, 4, 4, weights);
  const LeastSquaresResult found = bounded_least_squares(equations, {});
  EXPECT_TRUE(found.converged);
  // The tolerance 1e-12 of the equations over their smallest singular value, about 0.1.
  for (std::size_t v = 0; v < weights.size(); ++v) EXPECT_NEAR(found.weights[v], weights[v], 1e-9);
}

TEST(BoundedLeastSquares, MeetsEvenEquationsToo) {
  std::vector<double> weights;
  const PointEquations equations = ring(40, 8, 6, weights, 7);
  const LeastSquaresResult found = bounded_least_squares(equations, {});
  EXPECT_LT(largest_residual(equations, found.weights), 1e-10);
}

/// The last row of three points in turn, summed at the first of them.
PointEquations group_by_three(PointEquations equations) {
  const std::size_t rows = static_cast<std::size_t>(equations.rows);
  for (Index p = 0; p < equations.num_points(); ++p) {
    equations.group.push_back(p - p % 3);
    if (p % 3 == 0) continue;
    double& own = equations.right[(p + 1) * rows - 1];
    equations.right[(p - p % 3 + 1) * rows - 1] += own;
    own = 0.0;
  }
  return equations;
}

/// Weights that fit each point fit the groups; the least change is smaller than that of any others
/// that fit.
TEST(BoundedLeastSquares, LastRowsHoldForGroups) {
  std::vector<double> weights;
  const PointEquations equations = group_by_three(ring(60, 5, 4, weights, 8));
  const LeastSquaresResult found = bounded_least_squares(equations, {});
  EXPECT_TRUE(found.converged);
  double of_groups = 0.0, of_points = 0.0;
  std::vector<double> sums(60, 0.0);
  for (std::size_t v = 0; v < weights.size(); ++v) {
    of_groups += std::pow(found.weights[v] - 1.0, 2);
    of_points += std::pow(weights[v] - 1.0, 2);
    for (const Index p : {equations.first[v], equations.second[v]}) {
      sums[equations.group[p]] += equations.coefficients[v * 5 + 4] * found.weights[v];
    }
  }
  for (Index p = 0; p < 60; ++p) EXPECT_NEAR(sums[p], equations.right[p * 5 + 4], 1e-10);
  EXPECT_LT(of_groups, 0.99 * of_points);
}

/// In the plane boxes cost more than some hundred iterations, as rough searches take them; long
/// ones get boxes.
TEST(BoundedLeastSquares, BoxesComeLateInThePlane) {
  std::vector<double> weights;
  LeastSquaresOptions options;
  options.preconditioner = Preconditioner::blocks_then_boxes;
  for (const double tolerance : {1e-4, 1e-12}) {
    options.tolerance = tolerance;
    KeptPreconditioner kept;
    const LeastSquaresResult found =
        bounded_least_squares(ring(400, 4, 4, weights, 5), options, kept);
    EXPECT_TRUE(found.converged);
    EXPECT_GT(found.iterations, 150);
    EXPECT_EQ(kept.boxes != nullptr, tolerance < 1e-6);
  }
}

/// Both minimise the same squares, with a coarse space (2500 points) or without, also for groups.
TEST(BoundedLeastSquares, ThePreconditionerChangesNoAnswer) {
  LeastSquaresOptions factor, boxes;
  factor.preconditioner = Preconditioner::factor;
  boxes.preconditioner = Preconditioner::blocks_then_boxes;
  for (const auto& [points, grouped] :
       {std::pair(400, false), std::pair(2500, false), std::pair(2500, true)}) {
    std::vector<double> weights;
    const PointEquations equations =
        grouped ? group_by_three(ring(points, 5, 4, weights, 6)) : ring(points, 4, 4, weights, 6);
    const LeastSquaresResult iterated = bounded_least_squares(equations, boxes);
    const LeastSquaresResult factorised = bounded_least_squares(equations, factor);
    EXPECT_TRUE(iterated.converged);
    EXPECT_TRUE(factorised.converged);
    if (!grouped) {
      EXPECT_LT(largest_residual(equations, iterated.weights), 1e-9);
    }
    for (std::size_t v = 0; v < weights.size(); ++v) {
      EXPECT_NEAR(iterated.weights[v], factorised.weights[v], 1e-8);
    }
  }
}

/// Every second variable of a ring gives its moment to its first end alone.
PointEquations one_ended_ring(std::vector<double>& weights) {
  PointEquations equations = ring(40, 8, 6, weights, 16);
  equations.one_ended = equations.num_variables() / 2;
  for (Index v = equations.one_ended; v < equations.num_variables(); ++v) {
    for (std::size_t r = 6; r < 8; ++r) {
      equations.right[equations.second[v] * 8 + r] -=
          equations.coefficients[v * 8 + r] * weights[v];
    }
  }
  return equations;
}

TEST(BoundedLeastSquares, MeetsEquationsOfOneEndedVariables) {
  std::vector<double> weights;
  const PointEquations equations = one_ended_ring(weights);
  ASSERT_LT(largest_residual(equations, weights), 1e-14);
  LeastSquaresOptions options;
  for (const Preconditioner preconditioner : {Preconditioner::blocks, Preconditioner::factor}) {
    options.preconditioner = preconditioner;
    const LeastSquaresResult found = bounded_least_squares(equations, options);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(largest_residual(equations, found.weights), 1e-10);
    EXPECT_LE(change_of(found.weights), change_of(weights));
  }
}

/// Bounds on both sides that a third of the weights meet: the minimum is unique, so both methods
/// find it. 1e-8: the tolerance 1e-12 of the equations over the square of their smallest singular
/// value.
TEST(BoundedLeastSquares, BothMethodsFindTheSameMinimum) {
  for (const bool soft : {false, true}) {
    std::vector<double> weights;
    PointEquations equations = one_ended_ring(weights);
    for (std::size_t v = 0; v < weights.size(); ++v) {
      equations.lower[v] = std::min(0.93, weights[v]);
      equations.upper[v] = std::max(1.07, weights[v]);
    }
    if (soft) equations.ridge.assign(8, 1e-3);
    LeastSquaresOptions options;
    const LeastSquaresResult newton = bounded_least_squares(equations, options);
    options.method = Method::interior_point;
    const LeastSquaresResult interior = bounded_least_squares(equations, options);
    EXPECT_TRUE(newton.converged);
    EXPECT_TRUE(interior.converged);
    EXPECT_GT(newton.at_lower, 20);
    for (std::size_t v = 0; v < weights.size(); ++v) {
      EXPECT_NEAR(interior.weights[v], newton.weights[v], 1e-8);
      EXPECT_GE(interior.weights[v], equations.lower[v]);
      EXPECT_LE(interior.weights[v], equations.upper[v]);
    }
  }
}

/// One equation asks for more than its bounded weights can give. With a price it is given up alone,
/// as far as it must be, and all others hold; least squares spread what is left.
TEST(BoundedLeastSquares, GivesUpTheEquationThatCannotBeMet) {
  std::vector<double> weights;
  PointEquations equations = ring(40, 8, 6, weights, 16);
  equations.upper.assign(weights.size(), 2.0);
  constexpr std::size_t impossible = 20 * 8 + 6;
  equations.right[impossible] += 12.0;
  const auto unmet = [&](const LeastSquaresResult& found) {
    std::size_t count = 0;
    const std::vector<double> rest = residuals(equations, found.weights);
    for (std::size_t k = 0; k < rest.size(); ++k)
      count += k != impossible && std::abs(rest[k]) > 1e-9;
    EXPECT_GT(rest[impossible], 0.1);
    return count;
  };
  LeastSquaresOptions options;
  options.method = Method::interior_point;
  EXPECT_GT(unmet(bounded_least_squares(equations, options)), 100u);
  for (const Preconditioner preconditioner : {Preconditioner::blocks, Preconditioner::factor}) {
    options.preconditioner = preconditioner;
    options.penalty = 1e5;
    options.tolerance = 1e-10;  // round-off of multipliers of this size
    const LeastSquaresResult found = bounded_least_squares(equations, options);
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(unmet(found), 0u);
    EXPECT_EQ(found.worst_point, 20);
  }
}

/// Where all can be met a price changes nothing.
TEST(BoundedLeastSquares, APriceChangesNoAnswerThatMeetsAll) {
  std::vector<double> weights;
  const PointEquations equations = ring(40, 8, 6, weights, 7);
  LeastSquaresOptions options;
  const LeastSquaresResult without = bounded_least_squares(equations, options);
  options.penalty = 1e5;
  const LeastSquaresResult with = bounded_least_squares(equations, options);
  for (std::size_t v = 0; v < weights.size(); ++v) {
    EXPECT_DOUBLE_EQ(with.weights[v], without.weights[v]);
  }
}

/// Few digits: weights of the interior point itself, off its bounds by less than the last gap.
TEST(BoundedLeastSquares, ACoarseToleranceStopsInside) {
  LeastSquaresOptions options;
  options.method = Method::interior_point;
  options.tolerance = 1e-2;
  std::vector<double> weights;
  const PointEquations equations = one_ended_ring(weights);
  const LeastSquaresResult found = bounded_least_squares(equations, options);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.at_lower, 0);
  EXPECT_LT(largest_residual(equations, found.weights), 0.2);
}

/// One equation w_1 + w_2 + w_3 = 1.5 and a bound w_3 >= 0.8: minimum of the squares by hand.
PointEquations one_point(double right, double lower) {
  PointEquations equations;
  equations.rows = 8;
  equations.odd = 6;
  equations.positions = {0.0, 0.0};
  equations.right = {0, 0, 0, 0, 0, 0, right, 0};
  equations.scale = {0, 0, 0, 0, 0, 0, 1, 0};
  for (int v = 0; v < 3; ++v) {
    equations.first.push_back(0);
    equations.second.push_back(0);
    equations.coefficients.insert(equations.coefficients.end(),
                                  {0, 0, 0, 0, 0, 0, 0.5, 0});  // acts twice
    equations.lower.push_back(v == 2 ? lower : 0.0);
    equations.upper.push_back(100.0);
  }
  return equations;
}

TEST(BoundedLeastSquares, SharesAChangeEqually) {
  const LeastSquaresResult found = bounded_least_squares(one_point(1.5, 0.0), {});
  for (const double w : found.weights) EXPECT_NEAR(w, 0.5, 1e-12);
}

TEST(BoundedLeastSquares, RespectsBoundsInsteadOfClamping) {
  const LeastSquaresResult found = bounded_least_squares(one_point(1.5, 0.8), {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.weights[0], 0.35, 1e-12);
  EXPECT_NEAR(found.weights[1], 0.35, 1e-12);
  EXPECT_DOUBLE_EQ(found.weights[2], 0.8);
  EXPECT_EQ(found.at_lower, 1);
}

/// The bounds allow no less than 0.8: what is left is 0.3 of the equation.
TEST(BoundedLeastSquares, SaysHowFarContradictionsAre) {
  for (const Method method : {Method::newton, Method::interior_point}) {
    LeastSquaresOptions options;
    options.method = method;
    const LeastSquaresResult found = bounded_least_squares(one_point(0.5, 0.8), options);
    EXPECT_FALSE(found.converged);
    EXPECT_NEAR(found.residual, 0.3, 1e-8);
    EXPECT_EQ(found.worst_point, 0);
    EXPECT_EQ(found.at_lower, 3);
  }
}

/// Equations that may be left at first end in the same place where they can be met, and where
/// they cannot with the least residual, as near as the last gap lets weights come to their bounds
/// (1e-2).
TEST(BoundedLeastSquares, EquationsThatMayBeLeftAtFirstChangeNoAnswer) {
  LeastSquaresOptions options;
  options.method = Method::interior_point;
  const LeastSquaresResult exact = bounded_least_squares(one_point(1.5, 0.8), options);
  options.regularisation = 1e-8;
  const LeastSquaresResult met = bounded_least_squares(one_point(1.5, 0.8), options);
  EXPECT_TRUE(met.converged);
  for (std::size_t v = 0; v < met.weights.size(); ++v) {
    EXPECT_NEAR(met.weights[v], exact.weights[v], 1e-12);
  }
  const PointEquations too_much = one_point(0.5, 0.8);
  const LeastSquaresResult infeasible = bounded_least_squares(too_much, options);
  EXPECT_FALSE(infeasible.converged);
  EXPECT_NEAR(infeasible.residual, 0.3, 3e-2);
  for (std::size_t v = 0; v < too_much.lower.size(); ++v) {
    EXPECT_GE(infeasible.weights[v], too_much.lower[v]);
  }
}

/// A search that is of use only below a residual of 0.1 ends early where 0.3 will be left, and is
/// the same as others where the equation can be met.
TEST(BoundedLeastSquares, GivesUpWhereTooMuchWillBeLeft) {
  LeastSquaresOptions patient;
  patient.method = Method::interior_point;
  patient.regularisation = 1e-8;
  LeastSquaresOptions brief = patient;
  brief.infeasible_above = 0.1;
  const LeastSquaresResult ended = bounded_least_squares(one_point(0.5, 0.8), brief);
  EXPECT_FALSE(ended.converged);
  EXPECT_LT(ended.iterations, bounded_least_squares(one_point(0.5, 0.8), patient).iterations);
  const LeastSquaresResult met = bounded_least_squares(one_point(1.5, 0.8), brief);
  EXPECT_TRUE(met.converged);
  EXPECT_EQ(met.weights, bounded_least_squares(one_point(1.5, 0.8), patient).weights);
}

/// Equations far from feasible shorten every step of the interior-point method, which ends then.
TEST(BoundedLeastSquares, EndsWhereStepsStayShort) {
  LeastSquaresOptions options;
  options.method = Method::interior_point;
  options.preconditioner = Preconditioner::factor;
  std::vector<double> weights;
  PointEquations equations = ring(60, 8, 6, weights, 9);
  const LeastSquaresResult met = bounded_least_squares(equations, options);
  EXPECT_TRUE(met.converged);
  EXPECT_FALSE(met.stalled);
  for (double& right : equations.right) right *= 1000.0;  // weights are at most 100
  const LeastSquaresResult far = bounded_least_squares(equations, options);
  EXPECT_FALSE(far.converged);
  EXPECT_TRUE(far.stalled);
  EXPECT_LT(far.iterations, 1000);
}

/// Least squares of change and residual: w = 1 - t, t = d / (3 + ridge) with d = 3 - 1.5.
TEST(BoundedLeastSquares, ARidgeTradesResidualForChange) {
  PointEquations equations = one_point(1.5, 0.0);
  equations.ridge.assign(8, 0.5);
  const LeastSquaresResult found = bounded_least_squares(equations, {});
  for (const double w : found.weights) EXPECT_NEAR(w, 1.0 - 1.5 / 3.5, 1e-12);
}

TEST(BoundedLeastSquares, RefusesRowsThatAreNotBuiltIn) {
  PointEquations equations;
  equations.rows = 7;
  EXPECT_THROW(bounded_least_squares(equations, {}), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
