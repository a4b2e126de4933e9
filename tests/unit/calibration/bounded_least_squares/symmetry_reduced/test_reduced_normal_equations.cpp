#include "calibration/bounded_least_squares/symmetry_reduced/reduced_normal_equations.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "calibration/bounded_least_squares/bounded_least_squares.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using test::two_weights;

/// A row without variables and one that repeats another, as symmetry makes them, do no harm.
TEST(ReducedNormalEquations, SolvesDependentRows) {
  const PointEquations equations = two_weights({1.0, 1.0, 0.0, 2.0, 2.0, 0.0}, {5.0, 5.0, 0.0});
  const LeastSquaresResult change = bounded_least_squares(equations, {});
  EXPECT_TRUE(change.converged);
  EXPECT_NEAR(change.weights[0], 1.4, 1e-10);  // (1, 2) 0.4 from (1, 1)
  EXPECT_NEAR(change.weights[1], 1.8, 1e-10);
}

/// Two equations that differ by 2e-5: their softest direction has an eigenvalue of 1e-10, as the
/// shift of a step before weights are settled, which leaves a half. From 4e-6 to the tolerance
/// twelve such steps would be needed.
TEST(ReducedNormalEquations, SettledStepsMeetSoftEquations) {
  constexpr double apart = 2e-5;
  const PointEquations equations =
      two_weights({1.0, 1.0, 1.0, 1.0 + apart}, {1.9, 1.9 + 0.7 * apart});
  LeastSquaresOptions options;
  options.tolerance = 1e-9;
  const LeastSquaresResult change = bounded_least_squares(equations, options);
  EXPECT_TRUE(change.converged);
  EXPECT_LT(change.iterations, 8);
  EXPECT_NEAR(change.weights[0], 1.2, 1e-4);  // the tolerance over what they differ by
  EXPECT_NEAR(change.weights[1], 0.7, 1e-4);
}

/// Sixty equations of one variable each, whose mobility falls to 1e-6 behind the first solution:
/// the preconditioner that was kept would take an iteration for nearly each of them. After ten,
/// what a factor costs at least, it is made anew, and brings some seven digits at a time.
TEST(ReducedNormalEquations, MakeAFactorAnewThatServesBadly) {
  constexpr Index count = 60;
  PointEquations equations;
  equations.dim = 3;
  equations.rows = 1;
  for (Index p = 0; p < count; ++p) {
    equations.first.push_back(p);
    equations.second.push_back(no_index);
    equations.unknown.push_back(p);
  }
  equations.coefficients.assign(count, 1.0);
  equations.lower.assign(count, 0.0);
  equations.upper.assign(count, 10.0);
  equations.right.assign(count, 1.0);
  equations.scale.assign(count, 1.0);
  IndependentRows rows;
  const ReducedEquations reduced = reduce(equations, rows);
  std::unique_ptr<ReducedFactor> kept;
  ReducedNormalEquations normal(reduced, kept);
  std::vector<double> direction;
  const std::vector<double> residual(count, 1.0);
  normal.prepare_if_stale(false, false);
  EXPECT_LE(normal.solve(residual, 1e-10, direction), 2);
  for (Index p = 0; p < count; ++p) {
    normal.active_weight[p] = std::pow(1e-6, static_cast<double>(p) / (count - 1));
  }
  normal.prepare_if_stale(false, false);
  EXPECT_LE(normal.solve(residual, 1e-10, direction), 16);
  for (Index p = 0; p < count; ++p) EXPECT_NEAR(direction[p] * normal.active_weight[p], 1.0, 1e-3);
}

}  // namespace
}  // namespace perilink
