#include "solver/supernodes/supernodal_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace perilink {
namespace {

/// A supernode with every width below, at and above the panel of eight columns.
struct Supernode {
  Index rows, columns;
  Eigen::MatrixXd block;  // rows x columns, what CHOLMOD leaves above the diagonal is NaN

  explicit Supernode(Index row_count, Index column_count)
      : rows(row_count), columns(column_count), block(rows, columns) {
    for (Index j = 0; j < columns; ++j) {
      for (Index r = 0; r < rows; ++r) {
        block(r, j) = r < j ? std::nan("") : std::sin(1.0 + 3.0 * r + 7.0 * j) / (1.0 + columns);
      }
      block(j, j) = 2.0 + j;  // D
    }
  }
  /// The whole unit lower factor, identity below the columns.
  Eigen::MatrixXd lower() const {
    Eigen::MatrixXd l = Eigen::MatrixXd::Identity(rows, rows);
    for (Index j = 0; j < columns; ++j) {
      for (Index r = j + 1; r < rows; ++r) l(r, j) = block(r, j);
    }
    return l;
  }
};

Eigen::VectorXd test_vector(Index size) {
  Eigen::VectorXd v(size);
  for (Index k = 0; k < size; ++k) v[k] = std::cos(2.0 + 5.0 * k);
  return v;
}

class Width : public testing::TestWithParam<std::pair<Index, Index>> {
 protected:
  Supernode node{GetParam().first, GetParam().second};
};

TEST_P(Width, ForwardSolvesTheTriangleAndEliminatesBelow) {
  Eigen::VectorXd local = test_vector(node.rows);
  const Eigen::VectorXd expected = node.lower().triangularView<Eigen::UnitLower>().solve(local);

  supernodal::forward(node.block.data(), node.rows, node.columns, 0, local.data());

  EXPECT_LT((local - expected).norm(), 1e-13 * expected.norm());  // round-off of a short sum
}

TEST_P(Width, ForwardMayStartAtTheFirstNonzero) {
  const Index start = node.columns / 2;
  Eigen::VectorXd local = test_vector(node.rows);
  local.head(start).setZero();
  const Eigen::VectorXd expected = node.lower().triangularView<Eigen::UnitLower>().solve(local);

  supernodal::forward(node.block.data(), node.rows, node.columns, start, local.data());

  EXPECT_LT((local - expected).norm(), 1e-13 * expected.norm());
}

TEST_P(Width, BackwardSolvesTheTransposedTriangle) {
  Eigen::VectorXd local = test_vector(node.rows);
  const Eigen::VectorXd expected =
      node.lower().transpose().triangularView<Eigen::UnitUpper>().solve(local);

  supernodal::backward(node.block.data(), node.rows, node.columns, local.data());

  EXPECT_LT((local - expected).norm(), 1e-13 * expected.norm());
}

TEST_P(Width, ChangeGivesTheFactorOfTheChangedMatrixAndSolvesWithTheOldOne) {
  const double sigma = -0.05;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(node.rows);
  for (Index j = 0; j < node.columns; ++j) diagonal[j] = node.block(j, j);
  const Eigen::VectorXd x = test_vector(node.rows);
  const Eigen::MatrixXd changed =
      node.lower() * diagonal.asDiagonal() * node.lower().transpose() + sigma * x * x.transpose();
  const Eigen::VectorXd p = node.lower().triangularView<Eigen::UnitLower>().solve(x);
  Eigen::VectorXd beta(node.columns);
  double s = sigma;
  for (Index j = 0; j < node.columns; ++j) {
    const double d = diagonal[j] + s * p[j] * p[j];
    beta[j] = s * p[j] / d;
    s *= diagonal[j] / d;
    diagonal[j] = d;
  }

  // Columns that this supernode does not have would take p to what is left of x.
  Eigen::VectorXd w = p;
  Eigen::VectorXd local = test_vector(node.rows);
  const Eigen::VectorXd solved =
      node.lower().transpose().triangularView<Eigen::UnitUpper>().solve(local);

  supernodal::backward_and_change(node.block.data(), node.rows, node.columns, p.data(), beta.data(),
                                  local.data(), w.data());

  EXPECT_LT((local - solved).norm(), 1e-13 * solved.norm());
  EXPECT_LT((w - x).norm(), 1e-13 * x.norm());

  // The columns of L D L' reproduce the columns of the changed matrix.
  const Eigen::MatrixXd product = node.lower() * diagonal.asDiagonal() * node.lower().transpose();
  EXPECT_LT((product - changed).leftCols(node.columns).norm(), 1e-13 * changed.norm());
}

/// Vectors that share columns and rows below: L D L' with what is left of them below is the whole
/// matrix less all of them.
TEST_P(Width, ChangeTogetherGivesTheFactorOfTheMatrixLessAllVectors) {
  for (const Index count : {1, 2, 3, 16}) {
    SCOPED_TRACE(count);
    Supernode changed = node;
    Eigen::MatrixXd diagonal = Eigen::MatrixXd::Identity(node.rows, node.rows);
    for (Index j = 0; j < node.columns; ++j) diagonal(j, j) = node.block(j, j);
    Eigen::MatrixXd w(node.rows, count);
    for (Index m = 0; m < count; ++m) {
      for (Index r = 0; r < node.rows; ++r) w(r, m) = 0.05 * std::sin(1.0 + 2.0 * m + 3.0 * r * r);
    }
    const Eigen::MatrixXd expected =
        node.lower() * diagonal * node.lower().transpose() - w * w.transpose();
    Eigen::VectorXd sigma = Eigen::VectorXd::Constant(count, -1.0);

    ASSERT_TRUE(supernodal::change_together(changed.block.data(), node.rows, node.columns, count,
                                            w.data(), sigma.data()));

    const Index below = node.rows - node.columns;
    for (Index j = 0; j < node.columns; ++j) diagonal(j, j) = changed.block(j, j);
    const Eigen::MatrixXd left = w.bottomRows(below);
    diagonal.bottomRightCorner(below, below) += left * sigma.asDiagonal() * left.transpose();
    const Eigen::MatrixXd product = changed.lower() * diagonal * changed.lower().transpose();
    EXPECT_LT((product - expected).norm(), 1e-13 * expected.norm());
    for (Index j = 0; j < node.columns; ++j) {
      for (Index r = 0; r < j; ++r) EXPECT_TRUE(std::isnan(changed.block(r, j)));
    }
  }
}

/// At the root -1 / sigma is the pivot of each vector after those before it.
TEST_P(Width, ChangeTogetherTellsThePivots) {
  if (node.rows != node.columns) return;
  constexpr Index count = 5;
  Eigen::MatrixXd diagonal = Eigen::MatrixXd::Identity(node.rows, node.rows);
  for (Index j = 0; j < node.columns; ++j) diagonal(j, j) = node.block(j, j);
  Eigen::MatrixXd matrix = node.lower() * diagonal * node.lower().transpose();
  Eigen::MatrixXd w(node.rows, count);
  for (Index m = 0; m < count; ++m) {
    w.col(m) = (0.1 + 0.05 * m) * test_vector(node.rows + m).tail(node.rows);
  }
  const Eigen::MatrixXd x = w;
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(count, -1.0);
  ASSERT_TRUE(supernodal::change_together(node.block.data(), node.rows, node.columns, count,
                                          w.data(), sigma.data()));
  for (Index m = 0; m < count; ++m) {
    EXPECT_NEAR(-1.0 / sigma[m], 1.0 - x.col(m).dot(matrix.ldlt().solve(x.col(m))), 1e-13) << m;
    matrix -= x.col(m) * x.col(m).transpose();
  }
}

/// Each of the vectors alone leaves something, and two of them nothing.
TEST_P(Width, ChangeTogetherFindsOutWhereNothingIsLeft) {
  const Index last = node.columns - 1;
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(node.rows, 2);
  w.row(last).setConstant(0.8 * std::sqrt(node.block(last, last)));
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(2, -1.0);
  Supernode one = node;
  Eigen::MatrixXd first = w.leftCols(1);
  EXPECT_TRUE(supernodal::change_together(one.block.data(), node.rows, node.columns, 1,
                                          first.data(), sigma.data()));
  sigma.setConstant(-1.0);
  EXPECT_FALSE(supernodal::change_together(node.block.data(), node.rows, node.columns, 2, w.data(),
                                           sigma.data()));
}

INSTANTIATE_TEST_SUITE_P(Shapes, Width,
                         testing::Values(std::pair{1, 1}, std::pair{4, 4}, std::pair{5, 3},
                                         std::pair{8, 8}, std::pair{30, 8}, std::pair{31, 13},
                                         std::pair{40, 24}, std::pair{64, 17}));

}  // namespace
}  // namespace perilink
