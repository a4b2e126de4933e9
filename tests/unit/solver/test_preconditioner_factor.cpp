#include "solver/preconditioner_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "solver/factor_routes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

/// The rows of a lattice in the order of elimination.
SparseMatrix ordered_lattice() {
  const auto lattice = test::make_spring_lattice(20, 30, 3.0);
  return test::reordered(lattice.lower, elimination_order(lattice.lower));
}

TEST(PreconditionerFactor, SolvesToSinglePrecision) {
  SparseMatrix lower = ordered_lattice();
  PreconditionerFactor factor(lower, 2);
  for (const double scale : {1.0, 1e-6}) {  // the same pattern again
    lower *= scale;
    ASSERT_TRUE(factor.factorize(lower));
    const std::vector<double> right = test::random_vector(static_cast<Index>(lower.cols()), 1);
    std::vector<double> solution = right;
    factor.solve(solution);
    const Eigen::Map<const Eigen::VectorXd> x(solution.data(), lower.cols());
    const Eigen::Map<const Eigen::VectorXd> b(right.data(), lower.cols());
    const Eigen::VectorXd rest = b - lower.selfadjointView<Eigen::Lower>() * x;
    // Residuals of a solution by a factor do not grow with the condition of the matrix.
    EXPECT_LT(rest.norm() / b.norm(), 1e-3);
    EXPECT_GT(rest.norm() / b.norm(), 1e-12) << "the factor is not in single precision";
  }
}

TEST(PreconditionerFactor, SaysWhereThereIsNone) {
  SparseMatrix lower = ordered_lattice();
  PreconditionerFactor factor(lower, 1);
  lower.coeffRef(100, 100) = -1.0;
  EXPECT_FALSE(factor.factorize(lower));
  lower.coeffRef(100, 100) = 1e3;
  EXPECT_TRUE(factor.factorize(lower));
  for (const double number : {1e60, std::numeric_limits<double>::quiet_NaN()}) {
    lower.coeffRef(100, 100) = number;
    EXPECT_FALSE(factor.factorize(lower)) << number;
  }
}

TEST(PreconditionerFactor, TakesHalfTheMemory) {
  const SparseMatrix lower = ordered_lattice();
  const FactorStatistics single = PreconditionerFactor(lower, 1).statistics();
  const FactorStatistics whole = estimate_factor(lower, {});
  EXPECT_EQ(single.entries, whole.entries);
  EXPECT_NEAR(single.bytes, 0.5 * whole.bytes, 0.1 * whole.bytes);
  EXPECT_GT(single.flops, 0.0);
}

}  // namespace
}  // namespace perilink
