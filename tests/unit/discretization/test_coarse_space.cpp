#include "discretization/coarse_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

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

/// (A D A' + ridge) x.
Eigen::VectorXd apply(const PointEquations& equations, const std::vector<double>& active,
                      double ridge, const Eigen::VectorXd& x) {
  Eigen::VectorXd result = ridge * x;
  for (Index v = 0; v < equations.num_variables(); ++v) {
    if (active[v] == 0.0) continue;
    Eigen::Vector4d at_first, at_second;
    for (int r = 0; r < 4; ++r) {
      const double a = equations.coefficients[v * 4 + r];
      at_first[r] = a * equations.scale[equations.first[v] * 4 + r];
      at_second[r] = (r < equations.odd ? -a : a) * equations.scale[equations.second[v] * 4 + r];
    }
    const double product = at_first.dot(x.segment<4>(equations.first[v] * 4)) +
                           at_second.dot(x.segment<4>(equations.second[v] * 4));
    result.segment<4>(equations.first[v] * 4) += product * at_first;
    result.segment<4>(equations.second[v] * 4) += product * at_second;
  }
  return result;
}

/// With a box for each point the correction solves the system.
TEST(CoarseSpace, OfSinglePointsIsTheInverse) {
  const PointEquations equations = grid(6, 3);
  std::vector<double> active(static_cast<std::size_t>(equations.num_variables()), 1.0);
  for (std::size_t v = 0; v < active.size(); v += 7) active[v] = 0.0;
  constexpr double ridge = 0.1;
  const CoarseSpace space(equations, active, std::vector<double>(4, ridge),
                          {}, CoarseSpace::Boxes::of_single_points);
  std::mt19937 random(5);
  const Eigen::VectorXd x =
      Eigen::VectorXd::NullaryExpr(equations.num_points() * 4, [&] { return uniform(random); });
  const Eigen::VectorXd right = apply(equations, active, ridge, x);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(x.size());
  space.add_correction(right.data(), found.data());
  // Condition number of a hundred; the diagonal is perturbed by 1e-14 of its mean.
  EXPECT_LT((found - x).norm(), 1e-11 * x.norm());
}

/// Galerkin's correction removes all that its functions see: applied to the new residual it finds
/// nothing. Constant and linear functions are among them.
TEST(CoarseSpace, OfManyPointsLeavesNoSmoothResidual) {
  const PointEquations equations = grid(24, 0);
  const std::vector<double> active(static_cast<std::size_t>(equations.num_variables()), 1.0);
  const CoarseSpace space(equations, active, std::vector<double>(4, 0.0),
                          {}, CoarseSpace::Boxes::of_many_points);
  std::mt19937 random(5);
  const Eigen::VectorXd right =
      Eigen::VectorXd::NullaryExpr(equations.num_points() * 4, [&] { return uniform(random); });
  Eigen::VectorXd once = Eigen::VectorXd::Zero(right.size());
  space.add_correction(right.data(), once.data());
  const Eigen::VectorXd rest = right - apply(equations, active, 0.0, once);
  Eigen::VectorXd twice = Eigen::VectorXd::Zero(right.size());
  space.add_correction(rest.data(), twice.data());
  EXPECT_GT(once.norm(), 0.0);
  EXPECT_LT(twice.norm(), 1e-10 * once.norm());
  for (int r = 0; r < 4; ++r) {
    double sum = 0.0, first_moment = 0.0, size = 0.0;
    for (Index p = 0; p < equations.num_points(); ++p) {
      sum += rest[p * 4 + r];
      first_moment += equations.positions[2 * p] * rest[p * 4 + r];
      size += std::abs(right[p * 4 + r]);
    }
    EXPECT_NEAR(sum, 0.0, 1e-10 * size);
    EXPECT_NEAR(first_moment, 0.0, 1e-9 * size);
  }
}

}  // namespace
}  // namespace perilink
