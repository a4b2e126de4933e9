#include "solver/preconditioner_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "solver/factor_routes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

/// A lattice of points with two rows, of which every fifth has lost one and every seventh both.
struct Thinned {
  Thinned(int columns, int rows, double reach) {
    const auto lattice = test::make_spring_lattice(columns, rows, reach);
    const Index num_points = lattice.groups.back() + 1;
    sizes.assign(static_cast<std::size_t>(num_points), 0);
    std::vector<Index> kept(lattice.groups.size(), no_index), point;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Index p = lattice.groups[k];
      if (p % 7 == 6 || (p % 5 == 4 && sizes[p] == 1)) continue;
      ++sizes[p];
      kept[k] = static_cast<Index>(point.size());
      point.push_back(p);
    }
    std::vector<Eigen::Triplet<double, Index>> entries, edges;
    for (Index c = 0; c < lattice.size; ++c) {
      for (SparseMatrix::InnerIterator entry(lattice.lower, c); entry; ++entry) {
        const auto [p, q] = std::minmax({lattice.groups[c], lattice.groups[entry.row()]});
        edges.emplace_back(q, p, 1.0);
        if (kept[c] == no_index || kept[entry.row()] == no_index) continue;
        entries.emplace_back(kept[entry.row()], kept[c], entry.value());
      }
    }
    lower.resize(static_cast<Index>(point.size()), static_cast<Index>(point.size()));
    lower.setFromTriplets(entries.begin(), entries.end());
    graph.resize(num_points, num_points);
    graph.setFromTriplets(edges.begin(), edges.end());
    groups = std::move(point);
  }

  /// The matrix as a factor wants it.
  SparseMatrix in_order_of(const PreconditionerFactor& factor) const {
    std::vector<Index> order;
    for (const Index p : factor.order()) {
      const auto rows = std::ranges::equal_range(groups, p);
      for (auto row = rows.begin(); row != rows.end(); ++row) {
        order.push_back(static_cast<Index>(row - groups.begin()));
      }
    }
    return test::reordered(lower, order);
  }

  SparseMatrix lower, graph;
  std::vector<Index> sizes;   // rows per point
  std::vector<Index> groups;  // point of each row
};

/// So large that threads share the subtrees of a solution.
Thinned shared_lattice() { return {60, 60, 6.0}; }

/// The second one is full: supernodes of more than a thousand columns, which are parted.
TEST(PreconditionerFactor, SolvesToSinglePrecision) {
  for (const Thinned& lattice : {Thinned(20, 30, 3.0), Thinned(26, 26, 40.0), shared_lattice()}) {
    PreconditionerFactor factor(lattice.graph, lattice.sizes, 2);
    SparseMatrix lower = lattice.in_order_of(factor);
    for (const double scale : {1.0, 1e-6}) {  // the same pattern again
      lower *= scale;
      ASSERT_TRUE(factor.factorize(columns_of(lower)));
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
}

TEST(PreconditionerFactor, GivesTheSameBytesForAnyNumberOfThreads) {
  const Thinned lattice = shared_lattice();
  const FactorStatistics size = PreconditionerFactor(lattice.graph, lattice.sizes, 1).statistics();
  EXPECT_GT(size.entries, 2e6) << "threads would not share a solution";
  const std::vector<double> right =
      test::random_vector(static_cast<Index>(lattice.lower.cols()), 1);
  std::vector<double> one;
  for (const int threads : {1, 2, 3}) {
    PreconditionerFactor factor(lattice.graph, lattice.sizes, threads);
    ASSERT_TRUE(factor.factorize(columns_of(lattice.in_order_of(factor))));
    std::vector<double> solution = right;
    factor.solve(solution);
    if (threads == 1) one = solution;
    for (int again = 0; again < 4; ++again) {  // by one thread, and by several
      EXPECT_EQ(solution, one) << threads << " threads";
      solution = right;
      factor.solve(solution);
    }
  }
}

TEST(PreconditionerFactor, SaysWhereThereIsNone) {
  const Thinned lattice(20, 30, 3.0);
  PreconditionerFactor factor(lattice.graph, lattice.sizes, 1);
  SparseMatrix lower = lattice.in_order_of(factor);
  lower.coeffRef(100, 100) = -1.0;
  EXPECT_FALSE(factor.factorize(columns_of(lower)));
  lower.coeffRef(100, 100) = 1e3;
  EXPECT_TRUE(factor.factorize(columns_of(lower)));
  for (const double number : {1e60, std::numeric_limits<double>::quiet_NaN()}) {
    lower.coeffRef(100, 100) = number;
    EXPECT_FALSE(factor.factorize(columns_of(lower))) << number;
  }
}

/// As many numbers as the factor of all rows, but for supernodes that are joined elsewhere, and
/// little more than a triangle where all are in one.
TEST(PreconditionerFactor, TakesHalfTheMemory) {
  const Thinned sparse(40, 40, 3.0), full(26, 26, 40.0);
  const FactorStatistics single = PreconditionerFactor(sparse.graph, sparse.sizes, 1).statistics();
  const FactorStatistics whole = estimate_factor(sparse.lower, sparse.groups);
  EXPECT_EQ(single.size, whole.size);
  EXPECT_NEAR(single.entries, whole.entries, 0.1 * whole.entries);
  EXPECT_NEAR(single.bytes, 0.5 * whole.bytes, 0.1 * whole.bytes);
  EXPECT_GT(single.flops, whole.flops) << "zeros where supernodes were joined count";
  EXPECT_LT(single.flops, 1.5 * whole.flops);
  const double rows = static_cast<double>(full.lower.cols());
  EXPECT_LT(PreconditionerFactor(full.graph, full.sizes, 1).statistics().entries,
            0.75 * rows * rows);
}

}  // namespace
}  // namespace perilink
