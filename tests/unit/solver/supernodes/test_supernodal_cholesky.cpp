#include "solver/supernodes/supernodal_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/cholmod_support.hpp"
#include "solver/supernodes/supernodes.hpp"
#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

/// Wide enough that threads share supernodes of several tiles above the subtrees.
SparseMatrix wide_matrix() { return test::make_spring_lattice(60, 60, 3.0).lower; }

/// A pattern, and what CHOLMOD and the program make of it.
struct Factors {
  explicit Factors(const SparseMatrix& matrix)
      : lower(matrix), pattern(analyze_supernodal(session, lower, {})) {}

  template <class Number>
  Index compute(std::vector<Number>& values, int threads) {
    values.assign(pattern->xsize, Number{0});
    return factorize_supernodes(lower, *pattern, values.data(), threads);
  }
  /// L by CHOLMOD.
  CholmodFactorPtr reference() {
    CholmodFactorPtr factor(cholmod_copy_factor(pattern.get(), session.get()),
                            CholmodFactorDeleter{session.get()});
    cholmod_sparse matrix = view_lower(lower);
    cholmod_factorize(&matrix, factor.get(), session.get());
    return factor;
  }

  SparseMatrix lower;
  CholmodSession session;
  CholmodFactorPtr pattern;
};

/// Largest difference of the lower triangles, over the largest number.
template <class Number>
double difference(const cholmod_factor& reference, std::vector<Number>& values) {
  double largest = 0.0, difference = 0.0;
  for (Index s = 0; s < static_cast<Index>(reference.nsuper); ++s) {
    const Supernode<double> expected = supernode_of(reference, s);
    const Supernode<Number> found = supernode_of(reference, values.data(), s);
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
  std::vector<double> one, several;
  factors.compute(one, 1);
  for (const int threads : {2, 3, 5}) {
    factors.compute(several, threads);
    EXPECT_EQ(one, several) << threads << " threads";
  }
}

/// The first column in the order of elimination, whichever subtree meets its own first.
TEST(SupernodalCholesky, NamesTheFirstColumnThatFails) {
  for (const std::vector<Index>& wrong : {std::vector<Index>{7000}, {4000, 300}, {7199, 5000, 2}}) {
    SparseMatrix matrix = wide_matrix();
    for (const Index k : wrong) matrix.coeffRef(k, k) = -1.0;
    Factors factors(matrix);
    const auto expected = static_cast<Index>(factors.reference()->minor);
    EXPECT_EQ(expected, *std::ranges::min_element(wrong));
    for (const int threads : {1, 2, 4}) {
      std::vector<double> values;
      EXPECT_EQ(factors.compute(values, threads), expected) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace perilink
