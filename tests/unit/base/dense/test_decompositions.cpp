#include "base/dense/decompositions.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double round_off = 1e-14;

TEST(Decompositions, EigenvaluesAscend) {
  Matrix2d tensor;
  tensor << 2.0, 1.0, 1.0, 2.0;
  EXPECT_LT((eigenvalues(tensor) - Eigen::Vector2d(1.0, 3.0)).norm(), round_off);
  Eigen::Matrix3d in_space = 5.0 * Eigen::Matrix3d::Identity();
  in_space.topLeftCorner<2, 2>() = tensor;
  EXPECT_LT((eigenvalues(in_space) - Eigen::Vector3d(1.0, 3.0, 5.0)).norm(), round_off);
  const auto [values, vectors] = eigenvectors(tensor);
  EXPECT_LT((tensor * vectors - vectors * values.asDiagonal()).norm(), round_off);
  EXPECT_LT((vectors.transpose() * vectors - MatrixXd::Identity(2, 2)).norm(), round_off);
}

TEST(Decompositions, LeastSquaresTakesTheShortestSolution) {
  const VectorXd wanted = VectorXd::Constant(1, 2.0);
  EXPECT_LT((least_squares(MatrixXd(MatrixXd::Ones(1, 2)), wanted) - VectorXd::Ones(2)).norm(),
            round_off);
  const MatrixXd nearly = Eigen::Vector2d(1.0, 1e-10).asDiagonal();
  EXPECT_NEAR(least_squares<VectorXd>(nearly, VectorXd::Ones(2))[1], 1e10, 1e-4);
  EXPECT_EQ(least_squares<VectorXd>(nearly, VectorXd::Ones(2), 1e-9)[1], 0.0);
}

TEST(Decompositions, PseudoInverseOfRankOne) {
  const Eigen::Vector3d u(1.0, 2.0, 2.0);
  const Eigen::Vector2d v(3.0, 4.0);
  const MatrixXd expected = v * u.transpose() / (u.squaredNorm() * v.squaredNorm());
  EXPECT_LT((pseudo_inverse(u * v.transpose()) - expected).norm(), round_off);
}

TEST(Decompositions, LeastSquaresFitsALine) {
  MatrixXd places(3, 2);
  places << 1.0, 0.0, 1.0, 1.0, 1.0, 2.0;
  const Eigen::Vector3d values(0.0, 3.0, 0.0);  // their mean, and no slope
  const Eigen::Vector2d expected(1.0, 0.0);
  double ratio = 0.0;
  EXPECT_LT((least_squares_by_qr(places, values) - expected).norm(), round_off);
  EXPECT_LT((least_squares_by_svd(places, values, ratio) - expected).norm(), round_off);
  least_squares_by_svd(Eigen::Vector2d(4.0, 1.0).asDiagonal(), VectorXd::Ones(2), ratio);
  EXPECT_DOUBLE_EQ(ratio, 0.25);
}

TEST(Decompositions, SolvesWherePivotsAreLarge) {
  const MatrixXd matrix = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  MatrixXd values = MatrixXd::Identity(2, 2);
  EXPECT_FALSE(solve_symmetric(matrix, values, 0.25));
  EXPECT_EQ(values, MatrixXd::Identity(2, 2));
  EXPECT_TRUE(solve_symmetric(matrix, values, 0.2));
  EXPECT_LT((matrix * values - MatrixXd::Identity(2, 2)).norm(), round_off);
}

TEST(Decompositions, ComplementIsAtRightAngles) {
  const Eigen::Vector3d column(1.0, 2.0, 2.0);
  const MatrixXd others = complement(column);
  ASSERT_EQ(others.cols(), 2);
  EXPECT_LT((others.transpose() * column).norm(), round_off);
  EXPECT_LT((others.transpose() * others - MatrixXd::Identity(2, 2)).norm(), round_off);
}

}  // namespace
}  // namespace perilink
