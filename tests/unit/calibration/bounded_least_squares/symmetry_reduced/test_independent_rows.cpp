#include "calibration/bounded_least_squares/symmetry_reduced/independent_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "calibration/bounded_least_squares/bounded_least_squares.hpp"
#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using test::two_weights;

/// (1, 2), the same again and nothing: one row that is as long as all of them.
TEST(TurnedRows, AreABasisOfRowsThatFollowFromEachOther) {
  IndependentRows bases, others;
  const ReducedEquations reduced =
      reduce(two_weights({1.0, 1.0, 0.0, 2.0, 2.0, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(reduced.matrix.nonZeros(), 2);
  EXPECT_NEAR(reduced.matrix.squaredNorm(), 10.0, 1e-14);
  EXPECT_NEAR(reduced.matrix.coeff(0, 1), 2.0 * reduced.matrix.coeff(0, 0), 1e-14);
  EXPECT_NEAR(reduced.equations.right[0], 5.0 * reduced.matrix.coeff(0, 0), 1e-14);
  EXPECT_EQ(reduce(two_weights({1.0, 1.0, 1.0, 1.0 + 1e-5}, {2.0, 2.0}), others).matrix.nonZeros(),
            4);
  // A basis of an earlier search stays, but where it would miss something.
  const auto next = reduce(two_weights({1.0, 1.0, 0.0, 0.5, 0.5, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(next.matrix.nonZeros(), 2);
  const auto other = reduce(two_weights({1.0, 1.0, 0.0, 1.0, 0.0, 0.0}, {5.0, 5.0, 0.0}), bases);
  EXPECT_EQ(other.matrix.nonZeros(), 4);
}

/// Three points of four weights each, of which the third looks to its left like the first and to
/// its right like the second: its equation is half of the sum of theirs; and the same again.
PointEquations three_points(double third, Index copies = 1) {
  PointEquations equations;
  equations.rows = 1;
  const auto add = [&](Index point, Index unknown, double coefficient) {
    equations.first.push_back(point);
    equations.second.push_back(no_index);
    equations.unknown.push_back(unknown);
    equations.coefficients.push_back(coefficient);
  };
  for (Index p = 0; p < 3 * copies; p += 3) {
    for (const Index point : {p, p + 1}) {
      const Index mine = 2 * point;  // twice each: once for either side
      for (int side = 0; side < 2; ++side) {
        add(point, mine, 1.0);
        add(point, mine + 1, 0.5);
      }
      add(p + 2, mine, 1.0);
      add(p + 2, mine + 1, 0.5);
    }
    equations.right.insert(equations.right.end(), {4.0, 5.0, third});
  }
  equations.lower.assign(equations.first.size(), 0.0);
  equations.upper.assign(equations.first.size(), 10.0);
  equations.scale.assign(equations.right.size(), 0.5);
  equations.positions.assign(2 * equations.right.size(), 0.0);
  return equations;
}

TEST(ImpliedRows, AreLeftOut) {
  IndependentRows rows;
  ReducedEquations reduced = reduce(three_points(4.5), rows);
  EXPECT_TRUE(rows.implied.empty()) << "so few rows are not looked at";
  const Eigen::MatrixXd before = reduced.matrix.toDense();
  leave_out_implied(reduced, rows.implied);
  ASSERT_EQ(std::ranges::count(rows.implied, 1), 1);
  for (int row = 0; row < 3; ++row) {
    const bool implied = rows.implied[static_cast<std::size_t>(row)] != 0;
    const Eigen::VectorXd expected = (implied ? 0.0 : 1.0) * before.row(row).transpose();
    EXPECT_EQ(reduced.matrix.toDense().row(row).transpose(), expected);
    EXPECT_EQ(reduced.equations.right[static_cast<std::size_t>(row)] == 0.0, implied);
  }
}

/// Where there are many rows the search looks for those that follow, and meets them, too.
TEST(ImpliedRows, AreMet) {
  constexpr Index copies = 700;
  const PointEquations equations = three_points(4.5, copies);
  IndependentRows rows;
  reduce(equations, rows);
  EXPECT_EQ(std::ranges::count(rows.implied, 1), copies);
  const LeastSquaresResult change = bounded_least_squares(equations, {});
  EXPECT_TRUE(change.converged);
  std::vector<double> embedded(equations.right.size(), 0.0);
  for (std::size_t v = 0; v < change.weights.size(); ++v) {
    embedded[equations.first[v]] += equations.coefficients[v] * change.weights[v];
  }
  for (std::size_t p = 0; p < embedded.size(); ++p) {
    ASSERT_NEAR(embedded[p], equations.right[p], 1e-10);
  }
}

/// A right side that does not follow contradicts the others: all of them count.
TEST(ImpliedRows, StayWhereTheyContradictTheOthers) {
  IndependentRows rows;
  ReducedEquations reduced = reduce(three_points(4.6), rows);
  leave_out_implied(reduced, rows.implied);
  EXPECT_EQ(std::ranges::count(rows.implied, 1), 0);
  for (int row = 0; row < 3; ++row) EXPECT_GT(reduced.matrix.row(row).nonZeros(), 0);
}

/// The row that an earlier search left out, whose factor lacks it, comes last.
TEST(ImpliedRows, AreThoseOfAnEarlierSearch) {
  for (std::size_t row = 0; row < 3; ++row) {
    IndependentRows rows;
    ReducedEquations reduced = reduce(three_points(4.5), rows);
    rows.implied.assign(3, 0);
    rows.implied[row] = 1;
    leave_out_implied(reduced, rows.implied);
    EXPECT_EQ(std::ranges::count(rows.implied, 1), 1);
    EXPECT_EQ(rows.implied[row], 1) << row;
  }
}

/// Rows that follow from nothing any more count again.
TEST(ImpliedRows, CountAgainWhereOthersAreGone) {
  PointEquations equations = three_points(4.5);
  IndependentRows rows;
  ReducedEquations reduced = reduce(equations, rows);
  rows.implied = {0, 1, 1};
  for (Index& p : equations.first) p = p == 2 ? 0 : p;  // the third is empty, the others apart
  reduced = reduce(equations, rows);
  leave_out_implied(reduced, rows.implied);
  EXPECT_GT(reduced.matrix.row(1).nonZeros(), 0);
  EXPECT_NE(reduced.equations.right[1], 0.0);
}

}  // namespace
}  // namespace perilink
