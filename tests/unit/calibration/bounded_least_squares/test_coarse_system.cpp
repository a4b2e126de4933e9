#include "calibration/bounded_least_squares/coarse_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index of_box = 3;  // fields

/// A row of boxes of three fields each, with springs of the fields of a box to those of the next
/// ones and `support` to the ground.
struct Row {
  Row(Index boxes, double support) {
    for (Index b = 0; b <= boxes; ++b) matrix.first.push_back(b * of_box);
    for (Index b = 0; b < boxes; ++b) {
      for (Index to = b; to < std::min(boxes, b + 3); ++to) matrix.pairs.emplace_back(b, to);
    }
    matrix.blocks.assign(matrix.pairs.size(), MatrixXd::Zero(of_box, of_box));
    inside = matrix;
    for (Index b = 0; b < boxes; ++b) {
      matrix.block(b, b) += support * MatrixXd::Identity(of_box, of_box);
      for (Index to = b + 1; to < std::min(boxes, b + 3); ++to) {
        join(b, to, matrix);
        if (CoarseSystem::large_box(b) == CoarseSystem::large_box(to)) join(b, to, inside);
      }
    }
  }
  static void join(Index a, Index b, SubdomainMatrix& sum) {
    MatrixXd spring = MatrixXd::Identity(of_box, of_box);
    spring(0, 1) = spring(1, 0) = 0.3;
    sum.block(a, a) += spring;
    sum.block(b, b) += spring;
    sum.block(a, b) -= spring;
  }
  MatrixXd dense() const {
    MatrixXd all = MatrixXd::Zero(matrix.first.back(), matrix.first.back());
    for (std::size_t n = 0; n < matrix.pairs.size(); ++n) {
      const auto [a, b] = matrix.pairs[n];
      all.block(b * of_box, a * of_box, of_box, of_box) = matrix.blocks[n];
      all.block(a * of_box, b * of_box, of_box, of_box) = matrix.blocks[n].transpose();
    }
    return all;
  }
  SubdomainMatrix matrix, inside;
};

VectorXd solve(const CoarseSystem& system, VectorXd values) {
  system.solve({values.data(), static_cast<std::size_t>(values.size())});
  return values;
}

/// Eigenvalues of what the system leaves of a matrix: all one where it is solved.
VectorXd eigenvalues(const CoarseSystem& system, const MatrixXd& matrix) {
  MatrixXd inverse(matrix.rows(), matrix.cols());
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    inverse.col(k) = solve(system, VectorXd::Unit(matrix.rows(), k));
  }
  EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-10 * inverse.norm());
  const MatrixXd lower = matrix.llt().matrixL();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(lower.transpose() * inverse * lower).eigenvalues();
}

TEST(CoarseSystem, SolvesFewBoxesExactly) {
  const Row row(8, 0.01);
  ASSERT_FALSE(CoarseSystem::is_nested(8));
  CoarseSystem system;
  system.factorize(row.matrix, row.inside);
  const VectorXd spectrum = eigenvalues(system, row.dense());
  EXPECT_NEAR(spectrum.minCoeff(), 1.0, 1e-10);
  EXPECT_NEAR(spectrum.maxCoeff(), 1.0, 1e-10);
}

/// Large boxes take what is soft in all, however many there are: the blocks of the single boxes
/// leave eigenvalues that fall with the support. No eigenvalue is above the three terms of an
/// additive preconditioner whose boxes meet two others each.
TEST(CoarseSystem, LeavesNothingSoftInManyBoxes) {
  const Index boxes = 144;
  ASSERT_TRUE(CoarseSystem::is_nested(boxes));
  for (const double support : {1e-2, 1e-6}) {
    const Row row(boxes, support);
    CoarseSystem system;
    system.factorize(row.matrix, row.inside);
    const VectorXd spectrum = eigenvalues(system, row.dense());
    EXPECT_GT(spectrum.minCoeff(), 0.02) << support;
    EXPECT_LT(spectrum.maxCoeff(), 4.0) << support;
  }
}

/// What nearly moves freely in one box: its block has a condition that single precision does not
/// hold, and the preconditioner has to stay definite.
TEST(CoarseSystem, StaysDefiniteWhereABlockIsNearlySingular) {
  Row row(144, 1.0);
  MatrixXd turned(of_box, of_box);
  turned << 2.0, 1.0, 2.0, -2.0, 2.0, 1.0, 1.0, 2.0, -2.0;
  turned /= 3.0;
  MatrixXd& own = row.matrix.block(70, 70);
  own = turned * Eigen::Vector3d(1.0, 0.5, 1e-10).asDiagonal() * turned.transpose();
  for (Index b = 68; b <= 72; ++b) {
    if (b != 70) row.matrix.block(b, 70).setZero();
    if (b != 70 && row.inside.has(b, 70)) row.inside.block(b, 70).setZero();
  }
  row.inside.block(70, 70) = 0.5 * own;
  CoarseSystem system;
  system.factorize(row.matrix, row.inside);
  for (Index k = 0; k < of_box; ++k) {
    const VectorXd right = VectorXd::Unit(144 * of_box, 70 * of_box + k);
    EXPECT_GT(right.dot(solve(system, right)), 0.0);
  }
  VectorXd soft = VectorXd::Zero(144 * of_box);
  soft.segment(70 * of_box, of_box) = turned.col(2);
  EXPECT_GT(soft.dot(solve(system, soft)), 1e9);
}

/// Pieces that fill whole boxes leave large boxes nothing that is soft.
TEST(CoarseSystem, NeedsNoSoftFields) {
  Row row(144, 1.0);
  for (std::size_t n = 0; n < row.matrix.pairs.size(); ++n) {
    if (row.matrix.pairs[n].first != row.matrix.pairs[n].second) row.matrix.blocks[n].setZero();
  }
  row.inside = row.matrix;
  CoarseSystem system;
  system.factorize(row.matrix, row.inside);
  const VectorXd spectrum = eigenvalues(system, row.dense());
  EXPECT_NEAR(spectrum.minCoeff(), 1.0, 1e-6);
  EXPECT_NEAR(spectrum.maxCoeff(), 1.0, 1e-6);
}

TEST(CoarseSystem, TakesOtherMatricesWithTheSameFields) {
  CoarseSystem system;
  const Row soft(144, 1e-6), stiff(144, 1e-3);
  system.factorize(soft.matrix, soft.inside);
  EXPECT_TRUE(system.has_fields());
  system.factorize(stiff.matrix, {});
  CoarseSystem other;
  other.factorize(stiff.matrix, stiff.inside);
  const VectorXd right = VectorXd::LinSpaced(144 * of_box, -1.0, 1.0);
  EXPECT_LT((solve(system, right) - solve(other, right)).norm(), 1e-2 * solve(other, right).norm());
}

}  // namespace
}  // namespace perilink
