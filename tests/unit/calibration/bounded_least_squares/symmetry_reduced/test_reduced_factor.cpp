#include "calibration/bounded_least_squares/symmetry_reduced/reduced_factor.hpp"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "calibration/bounded_least_squares/symmetry_reduced/reduce.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using test::two_weights;

/// The same factor serves behind bonds that are gone, not for rows that it does not have.
TEST(ReducedFactor, FitsEquationsWithFewerRows) {
  IndependentRows bases, others;
  const ReducedEquations one = reduce(two_weights({1.0, 1.0, 1.0, 1.0}, {2.0, 2.0}), others);
  const ReducedEquations two = reduce(two_weights({1.0, 1.0, 1.0, 2.0}, {2.0, 3.0}), bases);
  const ReducedEquations::Matrix columns_of_two = two.matrix.transpose();
  const ReducedEquations::Matrix columns_of_one = one.matrix.transpose();
  ReducedFactor large(two, columns_of_two), small(one, columns_of_one);
  EXPECT_TRUE(large.fits(one, columns_of_one));
  EXPECT_FALSE(small.fits(two, columns_of_two));
  const std::vector<double> active_weight = {1.0, 1.0}, shift = {0.0, 0.0}, right = {4.0, 0.0};
  std::vector<double> result(2);
  small.factorize(one.matrix, columns_of_one, active_weight, shift);
  small.solve(right, result);
  EXPECT_NEAR(result[0], 1.0, 1e-11);  // the row that is left has the square 4
  EXPECT_EQ(result[1], 0.0);
}

/// Variables between six points of three rows, two or three of them to an unknown.
PointEquations random_equations() {
  constexpr Index num_points = 6, num_variables = 70;
  std::mt19937 random(5);  // fixed: the same equations in every run
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  PointEquations equations;
  equations.rows = equations.odd = 3;
  for (Index v = 0; v < num_variables; ++v) {
    const auto first = static_cast<Index>(random() % num_points);
    const auto step = static_cast<Index>(1 + random() % 2);
    const Index second = first + step < num_points ? first + step : no_index;
    equations.first.push_back(first);
    equations.second.push_back(second);
    equations.unknown.push_back(v % 30);
    for (int r = 0; r < equations.rows; ++r) equations.coefficients.push_back(number(random));
  }
  equations.lower.assign(num_variables, 0.0);
  equations.upper.assign(num_variables, 10.0);
  equations.right.assign(static_cast<std::size_t>(num_points * equations.rows), 1.0);
  equations.scale.assign(equations.right.size(), 0.5);
  return equations;
}

TEST(ReducedFactor, IsThatOfTheSystem) {
  IndependentRows kept;
  const ReducedEquations reduced = reduce(random_equations(), kept);
  ReducedEquations::Matrix columns = reduced.matrix.transpose();
  const ReducedEquations::Matrix before = columns;
  ReducedFactor factor(reduced, columns);
  factor.sort(columns);
  EXPECT_EQ((columns.toDense() - before.toDense()).norm(), 0.0);
  Eigen::VectorXd active_weight(reduced.matrix.cols());
  for (Eigen::Index u = 0; u < active_weight.size(); ++u)
    active_weight[u] = u % 4 == 3 ? 0.0 : 1.0 / static_cast<double>(u + 1);
  const Eigen::VectorXd shift = Eigen::VectorXd::Constant(reduced.matrix.rows(), 0.01);
  const Eigen::MatrixXd dense = reduced.matrix.toDense();
  Eigen::MatrixXd system = dense * active_weight.asDiagonal() * dense.transpose();
  system.diagonal() += shift;
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(system.rows(), -1.0, 2.0);
  std::vector<double> found(static_cast<std::size_t>(right.size()));
  const auto span = [](const Eigen::VectorXd& x) {
    return std::span(x.data(), static_cast<std::size_t>(x.size()));
  };
  factor.factorize(reduced.matrix, columns, span(active_weight), span(shift));
  factor.solve(span(right), found);
  const Eigen::VectorXd expected = system.llt().solve(right);
  const Eigen::Map<const Eigen::VectorXd> solution(found.data(), right.size());
  EXPECT_LT((solution - expected).norm(), 1e-4 * expected.norm()) << "single precision";
}

}  // namespace
}  // namespace perilink
