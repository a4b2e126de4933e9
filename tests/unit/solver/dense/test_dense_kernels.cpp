#include "solver/dense/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace perilink {
namespace {

TEST(DenseKernels, AddAProduct) {
  const Eigen::MatrixXd a{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}}, b{{1.0, -1.0}};
  Eigen::MatrixXd sum = Eigen::MatrixXd::Ones(3, 1);
  add_product(a, b, sum);
  EXPECT_EQ(sum, Eigen::MatrixXd::Zero(3, 1));
}

/// A chain of n points that can move as a whole: eigenvalues 2 - 2 cos(pi k / n). 1e-10: two
/// inverse iterations with a shift of 2e-6 leave (2e-6)^2 / 6e-3 of the second field in the first.
TEST(DenseKernels, FindEigenvectorsBelowALimit) {
  constexpr int n = 40;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k + 1 < n; ++k) {
    chain(k, k) += 1.0;
    chain(k + 1, k + 1) += 1.0;
    chain(k + 1, k) = chain(k, k + 1) = -1.0;
  }
  const double limit = 2.0 - 2.0 * std::cos(3.141592653589793 * 4.5 / n);
  const Eigen::MatrixXd found = eigenvectors_below(chain, limit, 10);
  ASSERT_EQ(found.cols(), 5);
  EXPECT_LT((chain * found.col(0)).norm(), 1e-10);
  EXPECT_LT((found.transpose() * found - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-13);
  EXPECT_EQ(eigenvectors_below(chain, -1.0, 10).cols(), 0);
}

/// A subspace that turns out to be too small is made larger; nothing resists anything in the end.
TEST(DenseKernels, FindMoreEigenvectorsThanExpected) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(30, 30);
  for (int k = 0; k < 14; ++k) matrix(k, k) = 1e-5 * k;
  const Eigen::MatrixXd found = eigenvectors_below(matrix, 0.01, 3);
  ASSERT_EQ(found.cols(), 14);
  EXPECT_LT(found.bottomRows(16).norm(), 1e-6);  // (1e-4 + shift)^2 of the stiff ones
  EXPECT_EQ(eigenvectors_below(Eigen::MatrixXd::Zero(4, 4), 0.01, 2).cols(), 4);
}

TEST(DenseKernels, RefuseWhatIsNotFinite) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(eigenvectors_below(matrix, 1.0, 3), SolverError);
}

}  // namespace
}  // namespace perilink
