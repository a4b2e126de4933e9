#include "calibration/least_change/tied_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "calibration/least_change/least_change.hpp"

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
TEST(TiedEquations, ChangesCountForEveryVariable) {
  const LeastChange change = least_change(three_weights(6.0), {});
  ASSERT_EQ(change.weights.size(), 3);
  EXPECT_TRUE(change.converged);
  for (const double w : change.weights) EXPECT_NEAR(w, 2.0, 1e-11);
}

TEST(TiedEquations, BoundsHoldForTheUnknown) {
  PointEquations equations = three_weights(6.0);
  equations.upper[0] = equations.upper[1] = 1.5;
  const LeastChange change = least_change(equations, {});
  EXPECT_NEAR(change.weights[0], 1.5, 1e-12);
  EXPECT_NEAR(change.weights[1], 1.5, 1e-12);
  EXPECT_NEAR(change.weights[2], 3.0, 1e-11);
}

TEST(TiedEquations, ColumnsAreSumsOverTheVariables) {
  std::vector<Eigen::MatrixXd> bases;
  const TiedEquations tied = tie(three_weights(6.0), bases);
  ASSERT_EQ(tied.matrix.cols(), 2);
  EXPECT_NEAR(tied.root[0], std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(tied.matrix.coeff(0, 0), 0.5 * 2.0 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(tied.matrix.coeff(0, 1), 0.5, 1e-15);
  EXPECT_EQ(tied.weights(std::vector<double>{1.0, 1.0}), (std::vector<double>{1.0, 1.0, 1.0}));
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
TEST(TiedEquations, OfOnePointLeadToTheSolutionOfAll) {
  constexpr Index points = 20, neighbours = 9;
  for (const double lower : {0.0, 0.9}) {
    for (const Method method : {Method::newton, Method::interior_point}) {
      const Ring ring = make_ring(points, neighbours, lower);
      LeastChangeOptions options;
      options.method = method;
      const LeastChange whole = least_change(ring.whole, options);
      const LeastChange one = least_change(ring.one, options);
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

/// Two weights of their own at one point.
PointEquations two_weights(std::vector<double> coefficients, std::vector<double> right) {
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

/// (1, 2), the same again and nothing: one row that is as long as all of them.
TEST(TiedEquations, HaveABasisForRowsThatFollowFromEachOther) {
  std::vector<Eigen::MatrixXd> bases, others;
  const TiedEquations tied =
      tie(two_weights({1.0, 1.0, 0.0, 2.0, 2.0, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(tied.matrix.nonZeros(), 2);
  EXPECT_NEAR(tied.matrix.squaredNorm(), 10.0, 1e-14);
  EXPECT_NEAR(tied.matrix.coeff(0, 1), 2.0 * tied.matrix.coeff(0, 0), 1e-14);
  EXPECT_NEAR(tied.equations.right[0], 5.0 * tied.matrix.coeff(0, 0), 1e-14);
  EXPECT_EQ(tie(two_weights({1.0, 1.0, 1.0, 1.0 + 1e-5}, {2.0, 2.0}), others).matrix.nonZeros(), 4);
  // A basis of an earlier search stays, but where it would miss something.
  const auto next = tie(two_weights({1.0, 1.0, 0.0, 0.5, 0.5, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(next.matrix.nonZeros(), 2);
  const auto other = tie(two_weights({1.0, 1.0, 0.0, 1.0, 0.0, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(other.matrix.nonZeros(), 4);
}

/// The same factor serves behind bonds that are gone, not for rows that it does not have.
TEST(TiedFactor, FitsEquationsWithFewerRows) {
  std::vector<Eigen::MatrixXd> bases, others;
  const TiedEquations one = tie(two_weights({1.0, 1.0, 1.0, 1.0}, {2.0, 2.0}), others);
  const TiedEquations two = tie(two_weights({1.0, 1.0, 1.0, 2.0}, {2.0, 3.0}), bases);
  const TiedEquations::Matrix columns_of_two = two.matrix.transpose();
  const TiedEquations::Matrix columns_of_one = one.matrix.transpose();
  TiedFactor large(two, columns_of_two), small(one, columns_of_one);
  EXPECT_TRUE(large.fits(one, columns_of_one));
  EXPECT_FALSE(small.fits(two, columns_of_two));
  const std::vector<double> mobility = {1.0, 1.0}, shift = {0.0, 0.0}, right = {4.0, 0.0};
  std::vector<double> result(2);
  small.factorize(columns_of_one, mobility, shift);
  small.solve(right, result);
  EXPECT_NEAR(result[0], 1.0, 1e-11);  // the row that is left has the square 4
  EXPECT_EQ(result[1], 0.0);
}

/// A row without variables and one that repeats another, as symmetry makes them, do no harm.
TEST(TiedNormalEquations, SolvesDependentRows) {
  const PointEquations equations = two_weights({1.0, 1.0, 0.0, 2.0, 2.0, 0.0}, {5.0, 5.0, 0.0});
  const LeastChange change = least_change(equations, {});
  EXPECT_TRUE(change.converged);
  EXPECT_NEAR(change.weights[0], 1.4, 1e-10);  // (1, 2) 0.4 from (1, 1)
  EXPECT_NEAR(change.weights[1], 1.8, 1e-10);
}

/// Two equations that differ by 2e-5: their softest direction has an eigenvalue of 1e-10, as the
/// shift of a step before weights are settled, which leaves a half. From 4e-6 to the tolerance
/// twelve such steps would be needed.
TEST(TiedNormalEquations, SettledStepsMeetSoftEquations) {
  constexpr double apart = 2e-5;
  const PointEquations equations =
      two_weights({1.0, 1.0, 1.0, 1.0 + apart}, {1.9, 1.9 + 0.7 * apart});
  LeastChangeOptions options;
  options.tolerance = 1e-9;
  const LeastChange change = least_change(equations, options);
  EXPECT_TRUE(change.converged);
  EXPECT_LT(change.iterations, 8);
  EXPECT_NEAR(change.weights[0], 1.2, 1e-4);  // the tolerance over what they differ by
  EXPECT_NEAR(change.weights[1], 0.7, 1e-4);
}

/// The minimum is unique, wherever the search starts.
TEST(TiedNormalEquations, GoOnFromMultipliers) {
  const PointEquations equations = make_ring(20, 9, 0.9).one;
  const LeastChange whole = least_change(equations, {});
  LeastChangeOptions options;
  options.tolerance = 1e-4;
  const LeastChange coarse = least_change(equations, options);
  ASSERT_EQ(coarse.multipliers.size(), equations.right.size());
  EXPECT_LT(coarse.iterations, whole.iterations);
  options.tolerance = 1e-12;
  options.start = coarse.multipliers;
  const LeastChange end = least_change(equations, options);
  EXPECT_TRUE(end.converged);
  EXPECT_LT(end.iterations, whole.iterations);
  for (std::size_t v = 0; v < whole.weights.size(); ++v) {
    EXPECT_NEAR(end.weights[v], whole.weights[v], 1e-9);
  }
}

/// Where nothing may be left by a step at settled weights the first such step ends the search.
TEST(TiedNormalEquations, EndWhereASettledStepLeavesTooMuch) {
  const PointEquations equations = make_ring(20, 9, 0.9).one;
  LeastChangeOptions options;
  options.contradiction = 0.0;
  EXPECT_FALSE(least_change(equations, options).converged);
  EXPECT_TRUE(least_change(equations, {}).converged);
}

}  // namespace
}  // namespace perilink
