#include "calibration/bounded_least_squares/equations_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "support/point_equations.hpp"

namespace perilink {
namespace {

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0 - 0.5; }

/// Points of a square grid, tied to their right and upper neighbours and along one diagonal by two
/// variables each, more than there are equations; of the four equations the first `odd` act against
/// each other.
PointEquations grid(Index side, int odd) {
  std::mt19937 random(11);
  PointEquations equations;
  equations.rows = 4;
  equations.odd = odd;
  const auto tie = [&](Index p, Index q) {
    for (int twice = 0; twice < 2; ++twice) {
      equations.first.push_back(p);
      equations.second.push_back(q);
      equations.lower.push_back(0.0);
      for (int r = 0; r < 4; ++r) equations.coefficients.push_back(uniform(random));
    }
  };
  for (Index j = 0; j < side; ++j) {
    for (Index i = 0; i < side; ++i) {
      const Index p = j * side + i;
      equations.positions.insert(equations.positions.end(), {double(i), double(j)});
      if (i + 1 < side) tie(p, p + 1);
      if (j + 1 < side) tie(p, p + side);
      if (i + 1 < side && j + 1 < side) tie(p, p + side + 1);
    }
  }
  equations.right.assign(static_cast<std::size_t>(side * side) * 4, 0.0);
  for (std::size_t k = 0; k < equations.right.size(); ++k) {
    equations.scale.push_back(1.0 + uniform(random));
  }
  return equations;
}

std::vector<double> some_active(const PointEquations& equations, std::size_t step) {
  std::vector<double> active(static_cast<std::size_t>(equations.num_variables()), 1.0);
  for (std::size_t v = 0; v < active.size(); v += step) active[v] = 0.0;
  return active;
}

/// And again with other weights, which need no new pattern.
TEST(EquationsFactor, SolvesTheSystem) {
  const PointEquations equations = grid(6, 3);
  constexpr double ridge = 0.1;
  EquationsFactor factor(equations);
  std::mt19937 random(5);
  for (const std::size_t step : {7, 3}) {
    const std::vector<double> active = some_active(equations, step);
    factor.factorize(equations, active, std::vector<double>(equations.right.size(), ridge));
    const Eigen::VectorXd x =
        Eigen::VectorXd::NullaryExpr(equations.num_points() * 4, [&] { return uniform(random); });
    const Eigen::VectorXd right = test::apply_system(equations, active, ridge, x);
    std::vector<double> found(equations.right.size());
    factor.solve({right.begin(), right.end()}, found);
    // Condition number of a hundred; the diagonal is perturbed by 1e-14 of its mean.
    EXPECT_LT((Eigen::Map<Eigen::VectorXd>(found.data(), x.size()) - x).norm(), 1e-11 * x.norm());
  }
}

/// Rows that no variable acts on, and rows that depend on others: one variable for four equations.
TEST(EquationsFactor, TakesSingularSystems) {
  PointEquations equations = grid(3, 4);
  std::vector<double> active(static_cast<std::size_t>(equations.num_variables()), 0.0);
  active[0] = 1.0;
  EquationsFactor factor(equations);
  factor.factorize(equations, active, std::vector<double>(equations.right.size(), 0.0));
  std::vector<double> right(equations.right.size(), 1.0), found(equations.right.size());
  factor.solve(right, found);
  for (const double value : found) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace perilink
