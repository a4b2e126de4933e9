#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numeric>

#include "io/case/case_words.hpp"
#include "solver/factor_routes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

using test::make_spring_lattice;
using test::random_vector;
using test::relative_difference;

/// Condition numbers here stay below 1e5.
constexpr double batch_tolerance = 1e-10;

std::vector<double> fresh_solution(const Eigen::MatrixXd& matrix, const std::vector<double>& rhs) {
  const Eigen::VectorXd solution =
      matrix.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(rhs.data(), rhs.size()));
  return {solution.begin(), solution.end()};
}

/// The vectors as columns.
Eigen::MatrixXd dense_batch(std::span<const SparseVector> x, Index size) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, static_cast<Index>(x.size()));
  for (std::size_t m = 0; m < x.size(); ++m) {
    for (int k = 0; k < x[m].size(); ++k) {
      dense(x[m].rows[k], static_cast<Index>(m)) = x[m].values[k];
    }
  }
  return dense;
}

SparseVector scaled(SparseVector x, double factor) {
  for (double& value : x.values) value *= factor;
  return x;
}

/// A lattice of bonds, some of which go or lose a part of their stiffness.
class Batches : public testing::TestWithParam<std::pair<FactorRoute, int>> {
 protected:
  Batches() : factor_(make_factor(GetParam().first, GetParam().second)) {
    factor_->factorize(lattice_.lower, lattice_.groups);
  }
  /// Different bonds, every third of which goes as a whole.
  std::vector<SparseVector> random_bonds(std::size_t count, unsigned seed) const {
    std::vector<std::size_t> order(lattice_.springs.size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    std::vector<SparseVector> bonds;
    for (std::size_t k = 0; k < count; ++k) {
      bonds.push_back(scaled(lattice_.springs[order[k]], k % 3 == 0 ? 1.0 : 0.7));
    }
    return bonds;
  }
  Eigen::MatrixXd without(std::span<const SparseVector> bonds) const {
    const Eigen::MatrixXd x = dense_batch(bonds, lattice_.size);
    return lattice_.dense() - x * x.transpose();
  }
  void expect_factor_of(const Eigen::MatrixXd& matrix, unsigned seed) {
    const auto rhs = random_vector(lattice_.size, seed);
    std::vector<double> solution(rhs.size());
    factor_->solve(rhs, solution);
    EXPECT_LT(relative_difference(solution, fresh_solution(matrix, rhs)), batch_tolerance);
  }
  /// Forces of a bond and on two particles far away.
  SparseVector few_forces() const {
    SparseVector b = lattice_.springs[lattice_.springs.size() / 2];
    b.add(0, 0.3);
    b.add(lattice_.size - 1, -2.0);
    return b;
  }

  const test::SpringLattice lattice_ = make_spring_lattice(13, 17, 3.0);
  std::unique_ptr<Factor> factor_;
};

TEST_P(Batches, GoTogetherLikeAFreshFactorization) {
  unsigned seed = 1;
  for (const std::size_t count : {1U, 2U, 16U, 17U, 40U}) {
    SCOPED_TRACE(count);
    factor_->refactorize(lattice_.lower);
    const auto bonds = random_bonds(count, ++seed);
    EXPECT_GT(factor_->downdate_together(bonds), 0.0);
    expect_factor_of(without(bonds), seed);
  }
}

/// One batch after the other, with looks, changes of one bond and solutions between them.
TEST_P(Batches, FollowOneAnotherAndSingleRemovals) {
  const auto bonds = random_bonds(30, 11);
  const std::span<const SparseVector> all = bonds;
  const auto expect_pivot = [&](const SparseVector& x, std::size_t gone) {
    const Eigen::VectorXd dense = dense_batch({&x, 1}, lattice_.size);
    const double left = 1.0 - dense.dot(without(all.first(gone)).ldlt().solve(dense));
    EXPECT_NEAR(factor_->pivot(x), left, batch_tolerance);
  };
  expect_pivot(bonds[12], 0);
  ASSERT_GT(factor_->downdate_together(all.first(12)), 0.0);
  expect_pivot(bonds[12], 12);
  std::vector<double> solution(static_cast<std::size_t>(lattice_.size), 0.0);
  factor_->add_solution(few_forces(), solution);
  const double pivot = factor_->pivot(bonds[12]), load_change = 0.0;
  factor_->add_solution(few_forces(), solution);
  factor_->downdate({&bonds[12], 1}, {&load_change, 1}, {&pivot, 1}, {});
  ASSERT_GT(factor_->downdate_together(all.subspan(13)), 0.0);
  expect_factor_of(without(bonds), 12);
}

/// No order of the batch leaves it more than its members have alone, nor less than the softest
/// motion of what is left, and the pivots multiply to the ratio of the determinants.
TEST_P(Batches, TellASmallestPivotWithinItsBounds) {
  for (const std::size_t count : {1U, 2U, 17U, 40U}) {
    SCOPED_TRACE(count);
    factor_->refactorize(lattice_.lower);
    const auto bonds = random_bonds(count, 20);
    const Eigen::MatrixXd x = dense_batch(bonds, lattice_.size);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(x.cols(), x.cols()) -
                                 x.transpose() * lattice_.dense().ldlt().solve(x);
    const double softest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(left).eigenvalues().minCoeff();
    const double smallest = factor_->downdate_together(bonds);
    EXPECT_GT(smallest, softest - batch_tolerance);
    EXPECT_LT(smallest, left.diagonal().minCoeff() + batch_tolerance);
    EXPECT_LT(std::pow(smallest, static_cast<double>(count)),
              left.determinant() * (1.0 + batch_tolerance));
    if (count == 1) {
      EXPECT_NEAR(smallest, left(0, 0), batch_tolerance);
    }
  }
}

/// Equal parts of one bond, with c = x' K^-1 x: the last of m has the pivot (1 - c) / (1 - c + c /
/// m), in whatever order they go.
TEST_P(Batches, ThePivotOfTheLastPartOfABondIsTheSmallest) {
  const SparseVector& bond = lattice_.springs[lattice_.springs.size() / 3];
  const Eigen::VectorXd x = dense_batch({&bond, 1}, lattice_.size);
  const double c = x.dot(lattice_.dense().ldlt().solve(x));
  for (const int parts : {1, 2, 16, 17, 40}) {
    SCOPED_TRACE(parts);
    factor_->refactorize(lattice_.lower);
    const std::vector<SparseVector> all(static_cast<std::size_t>(parts),
                                        scaled(bond, 1.0 / std::sqrt(parts)));
    EXPECT_NEAR(factor_->downdate_together(all), (1.0 - c) / (1.0 - c + c / parts),
                batch_tolerance);
    expect_factor_of(without({&bond, 1}), 30);
  }
}

TEST_P(Batches, SomeMayHoldNothingAndABatchMayBeEmpty) {
  EXPECT_EQ(factor_->downdate_together({}), 1.0);
  expect_factor_of(lattice_.dense(), 31);
  if (GetParam().first != FactorRoute::in_place) return;
  const std::vector<SparseVector> with_nothing = {{}, lattice_.springs[4], {}};
  EXPECT_GT(factor_->downdate_together(with_nothing), 0.0);
  expect_factor_of(without({&lattice_.springs[4], 1}), 32);
}

/// What would leave an indefinite matrix is found out wherever in the batch it is, and a new
/// factorisation starts anew.
TEST_P(Batches, WhatLeavesNothingIsRefusedAndForgotten) {
  for (const std::size_t place : {0U, 3U, 20U}) {
    SCOPED_TRACE(place);
    auto bonds = random_bonds(24, 40);
    bonds[place] = scaled(bonds[place], 10.0);
    EXPECT_EQ(factor_->downdate_together(bonds), 0.0);
    factor_->refactorize(lattice_.lower);
    expect_factor_of(lattice_.dense(), 41);
    const auto others = random_bonds(24, 42);
    EXPECT_GT(factor_->downdate_together(others), 0.0);
    expect_factor_of(without(others), 43);
  }
}

/// All bonds of a particle that hardly anything else holds.
TEST_P(Batches, BondsThatAloneHoldAParticleLeaveNextToNothing) {
  test::SpringLattice fixed = make_spring_lattice(13, 17, 3.0, 1e-13);
  for (const Index row : {0, 1, 24, 25}) fixed.lower.coeffRef(row, row) += 1.0;
  const Index particle = 7 * 13 + 6;
  std::vector<SparseVector> bonds;
  for (const SparseVector& x : fixed.springs) {
    if (std::ranges::count(x.rows, 2 * particle) > 0) bonds.push_back(x);
  }
  ASSERT_GT(bonds.size(), 16U);
  factor_->factorize(fixed.lower, fixed.groups);
  EXPECT_LT(factor_->downdate_together(bonds), 1e-9);
}

TEST_P(Batches, AddSolutionAddsWhatSolveFinds) {
  const auto bonds = random_bonds(20, 50);
  const auto start = random_vector(lattice_.size, 51);
  for (const bool changed : {false, true}) {
    if (changed) {
      ASSERT_GT(factor_->downdate_together(bonds), 0.0);
    }
    std::vector<double> all(start.size(), 0.0), expected(start.size()), solution = start;
    const SparseVector b = few_forces();
    for (int k = 0; k < b.size(); ++k) all[b.rows[k]] = b.values[k];
    factor_->solve(all, expected);
    for (std::size_t k = 0; k < start.size(); ++k) expected[k] += start[k];
    factor_->add_solution(b, solution);
    EXPECT_LT(relative_difference(solution, expected), 1e-13);  // round-off
    factor_->add_solution(scaled(b, -1.0), solution);
    EXPECT_LT(relative_difference(solution, start), 1e-13);
    factor_->add_solution({}, solution);
    EXPECT_LT(relative_difference(solution, start), 1e-13);
  }
}

TEST_P(Batches, AddSolutionKeepsWhatIsWantedCurrent) {
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(lattice_.size), 0);
  for (std::size_t k = 0; k < wanted.size(); k += 1 + k % 7) wanted[k] = k < wanted.size() / 3;
  factor_->keep_current(wanted);
  const auto bonds = random_bonds(20, 60);
  ASSERT_GT(factor_->downdate_together(bonds), 0.0);
  const SparseVector b = few_forces();
  std::vector<double> all(wanted.size(), 0.0), solution(wanted.size(), 1.0);
  for (int k = 0; k < b.size(); ++k) all[b.rows[k]] = b.values[k];
  const auto expected = fresh_solution(without(bonds), all);
  factor_->add_solution(b, solution);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (wanted[k]) {
      EXPECT_NEAR(solution[k], 1.0 + expected[k], 1e-9) << k;
    }
  }
  // Removals one by one and whole solutions still do.
  expect_factor_of(without(bonds), 61);
}

TEST_P(Batches, PathsAddUp) {
  const auto bonds = random_bonds(10, 70);
  double sum = 0.0;
  for (const SparseVector& bond : bonds) {
    const double path = factor_->path_of({&bond, 1});
    EXPECT_GT(path, 0.0);
    EXPECT_LE(path, factor_->statistics().entries * (1.0 + 1e-12));
    sum += path;
  }
  EXPECT_NEAR(factor_->path_of(bonds), sum, 1e-9 * sum);
  EXPECT_EQ(factor_->path_of({}), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Routes, Batches,
                         testing::Values(std::pair{FactorRoute::in_place, 1},
                                         std::pair{FactorRoute::in_place, 3},
                                         std::pair{FactorRoute::cholmod_updown, 1},
                                         std::pair{FactorRoute::refactorize, 1}),
                         [](const auto& test) {
                           return std::string(word_of(test.param.first)) + "_" +
                                  std::to_string(test.param.second);
                         });

/// The paths of single bonds are a small part of a large factor, and less of it is counted then.
TEST(InPlaceBatches, CountTheirPathsOnly) {
  const auto lattice = make_spring_lattice(40, 40, 2.3);
  const auto factor = make_factor(FactorRoute::in_place, 1);
  factor->factorize(lattice.lower, lattice.groups);
  for (const std::size_t k : {10U, 500U, 2000U, 4000U}) {
    const SparseVector& x = lattice.springs[k];
    const double pivot = factor->pivot(x), load_change = 0.0;
    EXPECT_LT(factor->path_of({&x, 1}), 0.6 * factor->statistics().entries);
    factor->downdate({&x, 1}, {&load_change, 1}, {&pivot, 1}, {});
  }
}

/// Large enough that the factor has more numbers than the smallest that is solved in parallel.
TEST(InPlaceBatches, GiveTheSameBytesForAnyNumberOfThreads) {
  const auto lattice = make_spring_lattice(75, 75, 3.0);
  std::vector<std::vector<double>> solutions;
  for (const int threads : {1, 2, 3}) {
    const auto factor = make_factor(FactorRoute::in_place, threads);
    factor->factorize(lattice.lower, lattice.groups);
    EXPECT_GT(factor->statistics().entries, 2e6) << "too small to be solved in parallel";
    std::vector<double> solution(static_cast<std::size_t>(lattice.size), 0.0);
    std::vector<SparseVector> bonds;
    for (std::size_t k = 0; k < 40; ++k) bonds.push_back(lattice.springs[150 * k]);
    EXPECT_GT(factor->downdate_together(bonds), 0.0);
    for (const SparseVector& bond : bonds) factor->add_solution(bond, solution);
    solutions.push_back(solution);
  }
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

}  // namespace
}  // namespace perilink
