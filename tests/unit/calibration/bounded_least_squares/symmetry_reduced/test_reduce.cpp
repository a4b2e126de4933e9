#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "calibration/bounded_least_squares/bounded_least_squares.hpp"

namespace perilink {
namespace {

/// One equation w_0 + w_1 + w_2 = right; the first two weights are equal.
PointEquations three_weights(double right) {
  PointEquations equations;
  equations.rows = 1;
  equations.first = {0, 0, 0};
  equations.second = {no_index, no_index, no_index};
  equations.unknown = {7, 7, 4};
  equations.coefficients = {1.0, 1.0, 1.0};
  equations.lower.assign(3, 0.0);
  equations.upper.assign(3, 10.0);
  equations.right = {right};
  equations.scale = {0.5};
  equations.positions = {0.0, 0.0};
  return equations;
}

/// Each variable counts: 2 (u - 1)^2 + (v - 1)^2 with 2 u + v = 6 is least at u = v = 2.
TEST(ReducedEquations, ChangesCountForEveryVariable) {
  const LeastSquaresResult change = bounded_least_squares(three_weights(6.0), {});
  ASSERT_EQ(change.weights.size(), 3);
  EXPECT_TRUE(change.converged);
  for (const double w : change.weights) EXPECT_NEAR(w, 2.0, 1e-11);
}

TEST(ReducedEquations, BoundsHoldForTheUnknown) {
  PointEquations equations = three_weights(6.0);
  equations.upper[0] = equations.upper[1] = 1.5;
  const LeastSquaresResult change = bounded_least_squares(equations, {});
  EXPECT_NEAR(change.weights[0], 1.5, 1e-12);
  EXPECT_NEAR(change.weights[1], 1.5, 1e-12);
  EXPECT_NEAR(change.weights[2], 3.0, 1e-11);
}

TEST(ReducedEquations, ColumnsAreSumsOverTheVariables) {
  IndependentRows bases;
  const ReducedEquations reduced = reduce(three_weights(6.0), bases);
  ASSERT_EQ(reduced.matrix.cols(), 2);
  EXPECT_NEAR(reduced.root[0], std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(reduced.matrix.coeff(0, 0), 0.5 * 2.0 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(reduced.matrix.coeff(0, 1), 0.5, 1e-15);
  EXPECT_EQ(reduced.weights(std::vector<double>{1.0, 1.0}), (std::vector<double>{1.0, 1.0, 1.0}));
}

/// A ring of points that are all alike, and the equations of one of them.
struct Ring {
  PointEquations whole, one;
};

Ring make_ring(Index points, Index neighbours, double lower) {
  constexpr int rows = 5;
  std::mt19937 random(11);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  Ring ring;
  for (PointEquations* equations : {&ring.whole, &ring.one}) equations->rows = rows;
  std::vector<double> right(rows, 0.0);
  const auto add = [&](PointEquations& equations, Index p, Index q, const std::vector<double>& a) {
    equations.first.push_back(p);
    equations.second.push_back(q);
    equations.lower.push_back(lower);
    equations.upper.push_back(10.0);
    equations.coefficients.insert(equations.coefficients.end(), a.begin(), a.end());
  };
  for (Index k = 1; k <= neighbours; ++k) {
    std::vector<double> a;
    for (int r = 0; r < rows; ++r) a.push_back(uniform());
    const double weight = 1.0 + uniform();
    for (int r = 0; r < rows; ++r) right[r] += 2.0 * a[r] * weight;
    for (Index p = 0; p < points; ++p) add(ring.whole, p, (p + k) % points, a);
    add(ring.one, 0, no_index, a);
    add(ring.one, no_index, 0, a);
    ring.one.unknown.insert(ring.one.unknown.end(), 2, k);
  }
  for (Index p = 0; p < points; ++p) {
    ring.whole.right.insert(ring.whole.right.end(), right.begin(), right.end());
    ring.whole.positions.insert(ring.whole.positions.end(), 2, static_cast<double>(p));
  }
  ring.one.right = right;
  ring.one.positions = {0.0, 0.0};
  for (PointEquations* equations : {&ring.whole, &ring.one}) {
    equations->scale.assign(equations->right.size(), 0.5);
  }
  return ring;
}

/// Without bounds in the way, with them, and by the other method: what is alike in the whole may as
/// well be tied.
TEST(ReducedEquations, OfOnePointLeadToTheSolutionOfAll) {
  constexpr Index points = 20, neighbours = 9;
  for (const double lower : {0.0, 0.9}) {
    for (const Method method : {Method::newton, Method::interior_point}) {
      const Ring ring = make_ring(points, neighbours, lower);
      LeastSquaresOptions options;
      options.method = method;
      const LeastSquaresResult whole = bounded_least_squares(ring.whole, options);
      const LeastSquaresResult one = bounded_least_squares(ring.one, options);
      ASSERT_TRUE(whole.converged);
      ASSERT_TRUE(one.converged);
      EXPECT_EQ(one.at_lower > 0, lower > 0.5);
      for (Index k = 0; k < neighbours; ++k) {
        for (Index p = 0; p < points; ++p) {
          EXPECT_NEAR(whole.weights[k * points + p], one.weights[2 * k], 1e-9);
        }
        EXPECT_EQ(one.weights[2 * k], one.weights[2 * k + 1]);
      }
    }
  }
}

/// The minimum is unique, wherever the search starts.
TEST(ReducedEquations, GoOnFromMultipliers) {
  const PointEquations equations = make_ring(20, 9, 0.9).one;
  const LeastSquaresResult whole = bounded_least_squares(equations, {});
  LeastSquaresOptions options;
  options.tolerance = 1e-4;
  const LeastSquaresResult coarse = bounded_least_squares(equations, options);
  ASSERT_EQ(coarse.multipliers.size(), equations.right.size());
  EXPECT_LT(coarse.iterations, whole.iterations);
  options.tolerance = 1e-12;
  options.start = coarse.multipliers;
  const LeastSquaresResult end = bounded_least_squares(equations, options);
  EXPECT_TRUE(end.converged);
  EXPECT_LT(end.iterations, whole.iterations);
  for (std::size_t v = 0; v < whole.weights.size(); ++v) {
    EXPECT_NEAR(end.weights[v], whole.weights[v], 1e-9);
  }
}

/// Where nothing may be left by a step at settled weights the first such step ends the search.
TEST(ReducedEquations, EndWhereASettledStepLeavesTooMuch) {
  const PointEquations equations = make_ring(20, 9, 0.9).one;
  LeastSquaresOptions options;
  options.infeasible_ratio = 0.0;
  EXPECT_FALSE(bounded_least_squares(equations, options).converged);
  EXPECT_TRUE(bounded_least_squares(equations, {}).converged);
}

}  // namespace
}  // namespace perilink
