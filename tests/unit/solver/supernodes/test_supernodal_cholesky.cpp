#include "solver/supernodes/supernodal_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "solver/cholmod_support.hpp"
#include "solver/factor_routes.hpp"
#include "solver/supernodes/supernodes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

/// Subtrees that do not depend on each other, and above them supernodes of several tiles.
SparseMatrix wide_matrix(int columns = 60, int rows = 60) {
  return test::make_spring_lattice(columns, rows, 3.0).lower;
}

std::vector<Index> one_each(const SparseMatrix& matrix) {
  std::vector<Index> each(static_cast<std::size_t>(matrix.cols()));
  std::iota(each.begin(), each.end(), 0);
  return each;
}

/// A pattern, and what CHOLMOD and the program make of it.
struct Factors {
  explicit Factors(SparseMatrix given)
      : matrix(std::move(given)), pattern(analyze_supernodal(session, matrix, one_each(matrix))) {}

  /// The row of the matrix that comes k-th.
  Index row(Index k) const { return static_cast<const Index*>(pattern->Perm)[k]; }
  template <class Number>
  Index compute(std::vector<Number>& values, int threads) {
    std::vector<Index> order;
    for (Index k = 0; k < static_cast<Index>(pattern->n); ++k) order.push_back(row(k));
    const SparseMatrix lower = test::reordered(matrix, order);
    values.assign(pattern->xsize, Number{0});
    std::vector<Number*> blocks;
    for (std::size_t s = 0; s < pattern->nsuper; ++s) {
      blocks.push_back(values.data() + static_cast<const Index*>(pattern->px)[s]);
    }
    return factorize_supernodes<Number>(columns_of(lower), *pattern, blocks, threads);
  }
  /// L by CHOLMOD.
  CholmodFactorPtr reference() {
    CholmodFactorPtr factor(cholmod_copy_factor(pattern.get(), session.get()),
                            CholmodFactorDeleter{session.get()});
    cholmod_sparse view = view_lower(matrix);
    cholmod_factorize(&view, factor.get(), session.get());
    return factor;
  }

  SparseMatrix matrix;
  CholmodSession session;
  CholmodFactorPtr pattern;
};

/// Largest difference of the lower triangles, over the largest number.
template <class Number>
double difference(const cholmod_factor& reference, std::vector<Number>& values) {
  double largest = 0.0, difference = 0.0;
  for (Index s = 0; s < static_cast<Index>(reference.nsuper); ++s) {
    const Supernode<double> expected = supernode_of(reference, s);
    Number* own = values.data() + static_cast<const Index*>(reference.px)[s];
    const Supernode<Number> found = supernode_of(reference, own, s);
    for (Index j = 0; j < expected.columns; ++j) {
      for (Index r = j; r < expected.count; ++r) {
        largest = std::max(largest, std::abs(expected.column(j)[r]));
        difference = std::max(difference, std::abs(expected.column(j)[r] - found.column(j)[r]));
      }
    }
  }
  return difference / largest;
}

TEST(SupernodalCholesky, HasTheNumbersOfCholmod) {
  for (const SparseMatrix& matrix :
       {test::make_spring_lattice(1, 2, 1.0).lower, test::make_spring_lattice(9, 7, 2.0).lower,
        test::make_spring_lattice(4, 90, 3.0).lower, wide_matrix()}) {
    Factors factors(matrix);
    const CholmodFactorPtr reference = factors.reference();
    std::vector<double> values;
    EXPECT_EQ(factors.compute(values, 2), static_cast<Index>(matrix.cols()));
    EXPECT_LT(difference(*reference, values), 1e-12) << "round-off of sums of up to 7200 numbers";
    std::vector<float> single;
    EXPECT_EQ(factors.compute(single, 2), static_cast<Index>(matrix.cols()));
    EXPECT_LT(difference(*reference, single), 1e-4) << "the same in single precision";
  }
}

TEST(SupernodalCholesky, GivesTheSameBytesForAnyNumberOfThreads) {
  Factors factors(wide_matrix());
  const SupernodeTree tree(*factors.pattern);
  Index widest = 0;
  for (Index s = 0; s < static_cast<Index>(factors.pattern->nsuper); ++s) {
    widest = std::max(widest, supernode_of(*factors.pattern, s).columns);
  }
  EXPECT_GT(widest, 256) << "no supernode of several panels and tiles";
  const std::vector<double> numbers(tree.parent.size(), 1.0);
  EXPECT_GT(tree.cut(numbers, 0.1 * static_cast<double>(numbers.size())).subtrees.size(), 8)
      << "nothing for threads to share";
  std::vector<double> one, several;
  factors.compute(one, 1);
  for (const int threads : {2, 3, 5}) {
    factors.compute(several, threads);
    EXPECT_EQ(one, several) << threads << " threads";
  }
}

/// The first column in the order of elimination, in whatever part of the tree and whichever part
/// meets its own first.
TEST(SupernodalCholesky, NamesTheFirstColumnThatFails) {
  std::mt19937 random(3);  // fixed: the same columns in every run
  for (const auto& [columns, rows] : {std::pair(60, 60), {150, 30}}) {
    for (int trial = 0; trial < 12; ++trial) {
      Factors factors(wide_matrix(columns, rows));  // numbers do not change the order
      Index first = static_cast<Index>(factors.matrix.cols());
      for (int k = 0; k < 2 + trial % 4; ++k) {
        const Index wrong =
            static_cast<Index>(random() % static_cast<unsigned>(factors.matrix.cols()));
        factors.matrix.coeffRef(factors.row(wrong), factors.row(wrong)) = -1.0;
        first = std::min(first, wrong);
      }
      EXPECT_EQ(static_cast<Index>(factors.reference()->minor), first);
      for (const int threads : {1, 2, 4, 8}) {
        std::vector<double> values;
        EXPECT_EQ(factors.compute(values, threads), first) << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace perilink
