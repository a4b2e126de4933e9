#include "solver/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigenvalues from 1 to `condition`, evenly on a scale of logarithms.
MatrixXd matrix_of(int size, double condition) {
  std::mt19937 random(5);  // fixed: the same matrix in every run
  std::normal_distribution<double> entry;
  const MatrixXd any = MatrixXd::NullaryExpr(size, size, [&] { return entry(random); });
  const MatrixXd q = any.householderQr().householderQ();
  VectorXd values(size);
  for (int k = 0; k < size; ++k) values[k] = std::pow(condition, k / (size - 1.0));
  return q * values.asDiagonal() * q.transpose();
}

LinearMap product_with(const MatrixXd& matrix) {
  return [&matrix](std::span<const double> x, std::span<double> result) {
    const auto size = static_cast<Eigen::Index>(x.size());
    Eigen::Map<VectorXd>(result.data(), size) = matrix * Eigen::Map<const VectorXd>(x.data(), size);
  };
}

const LinearMap identity = [](std::span<const double> x, std::span<double> result) {
  std::copy(x.begin(), x.end(), result.begin());
};

struct Search {
  MatrixXd matrix;
  VectorXd exact;
  std::vector<double> right, solution;

  Search(int size, double condition)
      : matrix(matrix_of(size, condition)), exact(VectorXd::Ones(size)), solution(size, 0.0) {
    const VectorXd load = matrix * exact;
    right.assign(load.data(), load.data() + size);
  }
  GradientsReport run(double enough, int most, const LinearMap& precondition = identity) {
    return conjugate_gradients(product_with(matrix), precondition, right, solution, enough, 0.0,
                               most);
  }
  /// Square root of the energy that is missing.
  double error() const {
    const VectorXd missing = exact - Eigen::Map<const VectorXd>(solution.data(), exact.size());
    return std::sqrt(missing.dot(matrix * missing));
  }
  double size() const { return std::sqrt(exact.dot(matrix * exact)); }
};

/// What is still missing is below what the last steps have added while these fall.
TEST(ConjugateGradients, TheErrorIsWhatWasAskedFor) {
  for (const double enough : {1e-3, 1e-6, 1e-9}) {
    Search search(200, 1e4);
    const GradientsReport report = search.run(enough, 1000);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(search.error(), enough * search.size());
    EXPECT_LE(search.error(), report.error);
    EXPECT_NEAR(report.energy, search.size() * search.size(),
                2.0 * enough * search.size() * search.size());
  }
}

TEST(ConjugateGradients, APerfectPreconditionerNeedsOneStep) {
  Search search(50, 1e6);
  const MatrixXd inverse = search.matrix.inverse();
  const GradientsReport report = search.run(1e-8, 1000, product_with(inverse));
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 12) << "twelve tell that nothing is missing";
  EXPECT_LE(search.error(), 1e-8 * search.size());
}

TEST(ConjugateGradients, SaysWhereItEndsTooEarly) {
  Search search(200, 1e6);
  const GradientsReport report = search.run(1e-9, 20);
  EXPECT_EQ(report.iterations, 20);
  EXPECT_FALSE(report.converged);
}

TEST(ConjugateGradients, NothingToSolveTakesNoStep) {
  Search search(20, 10.0);
  std::fill(search.right.begin(), search.right.end(), 0.0);
  const GradientsReport report = search.run(1e-9, 20);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
}

TEST(ConjugateGradients, RefusesAMatrixThatIsNotPositiveDefinite) {
  Search search(20, 10.0);
  search.matrix -= 5.0 * MatrixXd::Identity(20, 20);
  EXPECT_THROW(search.run(1e-9, 1000), NotPositiveDefinite);
}

/// A product of seven digits, and residuals of sixteen.
TEST(ConjugateGradients, CorrectionsGiveMoreDigitsThanTheProductHas) {
  Search search(200, 1e2);
  const MatrixXd rounded = search.matrix.cast<float>().cast<double>();
  const auto find_residual = [&](std::span<const double> solution, std::span<double> residual) {
    product_with(search.matrix)(solution, residual);
    for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = search.right[k] - residual[k];
  };
  const auto run = [&](const MatrixXd& matrix, const Correction& correction) {
    std::ranges::fill(search.solution, 0.0);
    return conjugate_gradients(product_with(matrix), identity, search.right, search.solution, 1e-10,
                               0.0, 1000, scalar_product, correction);
  };
  const GradientsReport exact = run(search.matrix, {});
  EXPECT_TRUE(run(rounded, {}).converged);
  EXPECT_GT(search.error(), 1e-8 * search.size());
  for (const bool keeps_solution : {false, true}) {
    const GradientsReport corrected = run(rounded, {find_residual, keeps_solution});
    EXPECT_TRUE(corrected.converged);
    EXPECT_LE(search.error(), 1e-10 * search.size());
    EXPECT_LT(corrected.iterations, exact.iterations + 6) << "a window of steps";
  }
  EXPECT_FALSE(run(2.0 * search.matrix, {find_residual}).converged)
      << "half of the residual is left";
}

/// A matrix with an eigenvalue of 1e-12 among those from 1 on.
TEST(ConjugateGradients, EndWhereAMatrixIsTooSoft) {
  Search search(200, 1e2);
  const VectorXd soft = VectorXd::Unit(200, 3);
  const MatrixXd others = MatrixXd::Identity(200, 200) - soft * soft.transpose();
  search.matrix = (others * search.matrix * others + 1e-12 * soft * soft.transpose()).eval();
  std::ranges::fill(search.right, 1.0);
  const GradientsReport report =
      conjugate_gradients(product_with(search.matrix), identity, search.right, search.solution,
                          1e-10, 0.0, 1000, scalar_product, {}, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_LT(report.softest, 1e-8);
  EXPECT_LT(report.iterations, 200) << "long before its solution is there";
}

}  // namespace
}  // namespace perilink
