#include "calibration/least_change/tied/tied_factor.hpp"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "calibration/least_change/tied/tie.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

using test::two_weights;

/// The same factor serves behind bonds that are gone, not for rows that it does not have.
TEST(TiedFactor, FitsEquationsWithFewerRows) {
  TiedRows bases, others;
  const TiedEquations one = tie(two_weights({1.0, 1.0, 1.0, 1.0}, {2.0, 2.0}), others);
  const TiedEquations two = tie(two_weights({1.0, 1.0, 1.0, 2.0}, {2.0, 3.0}), bases);
  const TiedEquations::Matrix columns_of_two = two.matrix.transpose();
  const TiedEquations::Matrix columns_of_one = one.matrix.transpose();
  TiedFactor large(two, columns_of_two), small(one, columns_of_one);
  EXPECT_TRUE(large.fits(one, columns_of_one));
  EXPECT_FALSE(small.fits(two, columns_of_two));
  const std::vector<double> mobility = {1.0, 1.0}, shift = {0.0, 0.0}, right = {4.0, 0.0};
  std::vector<double> result(2);
  small.factorize(one.matrix, columns_of_one, mobility, shift);
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

TEST(TiedFactor, IsThatOfTheSystem) {
  TiedRows kept;
  const TiedEquations tied = tie(random_equations(), kept);
  TiedEquations::Matrix columns = tied.matrix.transpose();
  const TiedEquations::Matrix before = columns;
  TiedFactor factor(tied, columns);
  factor.sort(columns);
  EXPECT_EQ((columns.toDense() - before.toDense()).norm(), 0.0);
  Eigen::VectorXd mobility(tied.matrix.cols());
  for (Eigen::Index u = 0; u < mobility.size(); ++u)
    mobility[u] = u % 4 == 3 ? 0.0 : 1.0 / static_cast<double>(u + 1);
  const Eigen::VectorXd shift = Eigen::VectorXd::Constant(tied.matrix.rows(), 0.01);
  const Eigen::MatrixXd dense = tied.matrix.toDense();
  Eigen::MatrixXd system = dense * mobility.asDiagonal() * dense.transpose();
  system.diagonal() += shift;
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(system.rows(), -1.0, 2.0);
  std::vector<double> found(static_cast<std::size_t>(right.size()));
  const auto span = [](const Eigen::VectorXd& x) {
    return std::span(x.data(), static_cast<std::size_t>(x.size()));
  };
  factor.factorize(tied.matrix, columns, span(mobility), span(shift));
  factor.solve(span(right), found);
  const Eigen::VectorXd expected = system.llt().solve(right);
  const Eigen::Map<const Eigen::VectorXd> solution(found.data(), right.size());
  EXPECT_LT((solution - expected).norm(), 1e-4 * expected.norm()) << "single precision";
}

}  // namespace
}  // namespace perilink
