#include "solver/blocks/block_gradients.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

using Eigen::MatrixXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, block_width, Eigen::RowMajor>;

/// Positive definite where `shift` is positive.
MatrixXd block_matrix(int size, double shift) {
  std::mt19937 random(5);  // fixed: the same matrix in every run
  std::normal_distribution<double> entry;
  const MatrixXd any = MatrixXd::NullaryExpr(size, size, [&] { return entry(random); });
  return any * any.transpose() / size + shift * MatrixXd::Identity(size, size);
}

BlockMap<double> block_product(const MatrixXd& matrix) {
  return as_block_map<double>([&matrix](std::span<const double> x, std::span<double> result) {
    Eigen::Map<Rows>(result.data(), matrix.rows(), block_width) =
        matrix * Eigen::Map<const Rows>(x.data(), matrix.rows(), block_width);
  });
}

const BlockMap<double> block_identity =
    as_block_map<double>([](std::span<const double> x, std::span<double> result) {
      std::copy(x.begin(), x.end(), result.begin());
    });

/// x'A x of every column.
BlockRow energies_of(const MatrixXd& matrix, const Rows& columns) {
  BlockRow energies{};
  for (int c = 0; c < block_width; ++c) {
    const Eigen::VectorXd column = columns.col(c);
    energies[c] = column.dot(matrix * column);
  }
  return energies;
}

TEST(BlockGradients, SolveEveryRightSideToItsOwnTolerance) {
  constexpr int size = 60;
  const MatrixXd matrix = block_matrix(size, 0.1);
  Rows exact = Rows::Random(size, block_width);
  exact.col(3) *= 1e-8;  // small beside the others
  exact.col(5).setZero();
  Rows right = matrix * exact, solution(size, block_width);
  solution.setOnes();  // no guess
  const GradientsReport report = block_conjugate_gradients<double>(
      block_product(matrix), block_identity, {right.data(), std::size_t(right.size())},
      {solution.data(), std::size_t(solution.size())}, energies_of(matrix, exact), 1e-9, 1000);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, size / 4);  // as many by itself each might take
  EXPECT_LE(report.error, 1e-9);
  for (int c = 0; c < block_width; ++c) {
    const Eigen::VectorXd missing = exact.col(c) - solution.col(c);
    const Eigen::VectorXd whole = exact.col(c);
    EXPECT_LE(std::sqrt(missing.dot(matrix * missing)), 1e-9 * std::sqrt(whole.dot(matrix * whole)))
        << c;
  }
  EXPECT_EQ(solution.col(5).cwiseAbs().maxCoeff(), 0.0);
}

TEST(BlockGradients, CountErrorsByTheSizesThatTheyAreGiven) {
  constexpr int size = 60;
  const MatrixXd matrix = block_matrix(size, 0.1);
  const Rows exact = Rows::Random(size, block_width);
  BlockRow sizes = energies_of(matrix, exact);
  for (double& energy : sizes) energy *= 1e-8;
  Rows right = matrix * exact, solution(size, block_width);
  const GradientsReport report = block_conjugate_gradients<double>(
      block_product(matrix), block_identity, {right.data(), std::size_t(right.size())},
      {solution.data(), std::size_t(solution.size())}, sizes, 1e-6, 1000);
  EXPECT_TRUE(report.converged);
  const BlockRow missing = energies_of(matrix, exact - solution);
  for (int c = 0; c < block_width; ++c) EXPECT_LE(std::sqrt(missing[c] / sizes[c]), 1e-6) << c;
}

/// Results that come row after row count as those that come at once.
TEST(BlockGradients, TakeResultsInParts) {
  constexpr int size = 60;
  const MatrixXd matrix = block_matrix(size, 0.1);
  const Rows exact = Rows::Random(size, block_width);
  const auto solve = [&](const BlockMap<double>& product) {
    Rows right = matrix * exact, solution(size, block_width);
    const GradientsReport report = block_conjugate_gradients<double>(
        product, block_identity, {right.data(), std::size_t(right.size())},
        {solution.data(), std::size_t(solution.size())}, energies_of(matrix, exact), 1e-9, 1000);
    return std::pair(report.iterations, solution);
  };
  const auto whole = solve(block_product(matrix));
  const auto parts = solve([&](auto x, auto result, const RowsDone& done) {
    block_product(matrix)(x, result, [](std::size_t, std::size_t, std::size_t) {});
    for (std::size_t begin = 0, part = 0; begin < size; begin += 7) {
      done(part++ % most_parts, begin, std::min<std::size_t>(begin + 7, size));
    }
  });
  EXPECT_EQ(parts.first, whole.first);
  EXPECT_LT((parts.second - whole.second).cwiseAbs().maxCoeff(), 1e-12);
}

/// Fewer steps than tell how they go on, and then none to take.
TEST(BlockGradients, EndWhereNothingIsMissing) {
  constexpr int size = 5;
  const MatrixXd matrix = 2.0 * MatrixXd::Identity(size, size);
  const Rows exact = Rows::Ones(size, block_width);
  Rows right = matrix * exact, solution(size, block_width);
  const GradientsReport report = block_conjugate_gradients<double>(
      block_product(matrix), block_identity, {right.data(), std::size_t(right.size())},
      {solution.data(), std::size_t(solution.size())}, energies_of(matrix, exact), 1e-9, 100);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LT((exact - solution).cwiseAbs().maxCoeff(), 1e-15);
}

/// block_conjugate_gradients() in single precision, with residuals in double.
class SingleSearch {
 public:
  SingleSearch(const MatrixXd& matrix, const Rows& right)
      : matrix_(matrix), rough_(matrix.cast<float>()), right_(right) {}
  GradientsReport run(const BlockRow& sizes, double enough) {
    SingleRows missing = right_.cast<float>(), found(right_.rows(), block_width);
    const GradientsReport report = block_conjugate_gradients<float>(
        as_block_map<float>([&](std::span<const float> x, std::span<float> result) {
          rows_of(result) =
              rough_ * Eigen::Map<const SingleRows>(x.data(), right_.rows(), block_width);
        }),
        as_block_map<float>([](std::span<const float> x, std::span<float> result) {
          std::ranges::copy(x, result.begin());
        }),
        numbers(missing), numbers(found), sizes, enough, 3000,
        [&](std::span<const float> part, std::span<float> left) {
          ++corrections;
          add(part);
          rows_of(left) = (right_ - matrix_ * sum_).cast<float>();
        });
    add(numbers(found));
    return report;
  }
  const Rows& solution() const { return sum_; }
  int corrections = 0;

 private:
  using SingleRows = Eigen::Matrix<float, Eigen::Dynamic, block_width, Eigen::RowMajor>;
  static std::span<float> numbers(SingleRows& rows) {
    return {rows.data(), std::size_t(rows.size())};
  }
  Eigen::Map<SingleRows> rows_of(std::span<float> rows) const {
    return {rows.data(), right_.rows(), block_width};
  }
  void add(std::span<const float> part) {
    sum_ += Eigen::Map<const SingleRows>(part.data(), right_.rows(), block_width).cast<double>();
  }

  const MatrixXd& matrix_;
  Eigen::MatrixXf rough_;
  Rows right_;
  Rows sum_ = Rows::Zero(right_.rows(), block_width);
};

/// Seven digits a step, and as many as the residuals have in the end.
TEST(BlockGradients, InSinglePrecisionResidualsGiveTheOtherDigits) {
  constexpr int size = 300;
  const MatrixXd matrix = block_matrix(size, 0.1);
  const Rows exact = Rows::Random(size, block_width);
  SingleSearch search(matrix, matrix * exact);
  const BlockRow sizes = energies_of(matrix, exact);
  const GradientsReport report = search.run(sizes, 1e-10);
  EXPECT_TRUE(report.converged);
  EXPECT_GE(search.corrections, 1);
  const BlockRow left = energies_of(matrix, exact - search.solution());
  for (int c = 0; c < block_width; ++c) EXPECT_LE(std::sqrt(left[c] / sizes[c]), 1e-10) << c;
}

/// A chain held at one end, its last half stiffer by `contrast`.
MatrixXd chain(int size, double contrast) {
  MatrixXd matrix = MatrixXd::Zero(size, size);
  for (int k = 0; k < size; ++k) {
    const double stiffness = 2 * k > size ? contrast : 1.0;
    matrix(k, k) += stiffness;
    if (k == 0) continue;
    matrix(k - 1, k - 1) += stiffness;
    matrix(k - 1, k) = matrix(k, k - 1) = -stiffness;
  }
  return matrix;
}

/// In a slender body a residual in single precision is believed to be small long before it is: an
/// answer holds what it says, as far as (L-2) tells it of a chain without boxes, or is none.
TEST(BlockGradients, InSinglePrecisionDoNotBelieveTheirOwnResiduals) {
  int answers = 0, none = 0;
  for (const auto& [size, contrast] : {std::pair{100, 1.0}, {200, 1.0}, {100, 1e3}, {100, 1e6}}) {
    const MatrixXd matrix = chain(size, contrast);
    const Rows exact = Rows::Random(size, block_width);
    SingleSearch search(matrix, matrix * exact);
    const BlockRow sizes = energies_of(matrix, exact);
    GradientsReport report;
    try {
      report = search.run(sizes, 1e-8);
    } catch (const NotPositiveDefinite&) {
    }
    ++(report.converged ? answers : none);
    if (!report.converged) continue;
    const BlockRow left = energies_of(matrix, exact - search.solution());
    for (int c = 0; c < block_width; ++c) EXPECT_LE(std::sqrt(left[c] / sizes[c]), 5e-8) << c;
  }
  EXPECT_GT(answers, 0);
  EXPECT_GT(none, 0);
}

/// What is not a number is not solved for, either.
TEST(BlockGradients, DoNotTakeWhatIsNoNumberForSolved) {
  constexpr int size = 5;
  const MatrixXd matrix = MatrixXd::Identity(size, size);
  Rows right = Rows::Constant(size, block_width, std::numeric_limits<double>::quiet_NaN());
  Rows solution(size, block_width);
  BlockRow sizes;
  sizes.fill(1.0);
  EXPECT_THROW(block_conjugate_gradients<double>(
                   block_product(matrix), block_identity, {right.data(), std::size_t(right.size())},
                   {solution.data(), std::size_t(solution.size())}, sizes, 1e-9, 100),
               NotPositiveDefinite);
}

TEST(BlockGradients, SayWhereTheyDoNotGetThere) {
  const MatrixXd matrix = block_matrix(60, 1e-3);
  Rows right = Rows::Random(60, block_width), solution(60, block_width);
  const std::span<double> r(right.data(), std::size_t(right.size()));
  const std::span<double> x(solution.data(), std::size_t(solution.size()));
  const BlockRow sizes = energies_of(matrix, matrix.inverse() * right);
  const GradientsReport report = block_conjugate_gradients<double>(
      block_product(matrix), block_identity, r, x, sizes, 1e-12, 5);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_GT(report.error, 1e-12);
  const MatrixXd indefinite = block_matrix(60, -1.0);
  right = Rows::Random(60, block_width);
  EXPECT_THROW(block_conjugate_gradients<double>(block_product(indefinite), block_identity, r, x,
                                                 sizes, 1e-12, 500),
               NotPositiveDefinite);
}

TEST(BlockGradients, AddsACombination) {
  const Rows columns = Rows::Random(7, block_width);
  const Eigen::VectorXd weights = Eigen::VectorXd::Random(block_width);
  Eigen::VectorXd result = Eigen::VectorXd::Ones(7);
  const Eigen::VectorXd expected = result + columns * weights;
  add_combination({columns.data(), std::size_t(columns.size())}, {weights.data(), block_width},
                  {result.data(), 7});
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace perilink
