#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "analysis/quasistatic/subdomains/subdomain_factor.hpp"
#include "assembly/element_vector.hpp"
#include "assembly/stiffness.hpp"
#include "solver/factor_routes.hpp"
#include "support/analysis_bodies.hpp"

namespace perilink {
namespace {

using namespace test;

/// Columns have errors of some 1e-6, whose squares are left.
constexpr double few_digits_of_columns = 1e-9, agreement = 1e-12;

double product(const SparseVector& x, std::span<const double> motion) {
  double sum = 0.0;
  for (int k = 0; k < x.size(); ++k) sum += x.values[k] * motion[x.rows[k]];
  return sum;
}

/// A block with a factor of few digits whose solutions wait, and one of all.
struct AgreeingBlock {
  AnalysisBody body = make_block({{"cubic", Pattern::cubic, Surface::none}, false, false, 6});
  std::vector<double> secants = intact(body.network), no_ground;
  SubdomainFactor subdomains{body.network, {.tolerance = 1e-9, .edge = 3}};
  std::unique_ptr<Factor> exact = make_factor(FactorRoute::in_place, 1);
  std::vector<SparseVector> vectors;

  AgreeingBlock() {
    subdomains.begin(body.unknowns, secants, no_ground);
    subdomains.defer();
    exact->factorize(assemble_stiffness(body.network, secants, body.unknowns),
                     body.unknowns.owners());
    for (Index e = 0; vectors.size() < 40; e += 11) {
      const ElementVectors parts = element_vectors(body.network, body.unknowns, e, 0.5);
      if (parts.x[0].size() > 0) vectors.push_back(parts.x[0]);
    }
  }
  /// What every two vectors have is exact, and what columns show of it; the columns are not.
  void expect_agreement() {
    double largest_error = 0.0;
    for (const SparseVector& b : vectors) {
      const std::vector<double> column = subdomains.columns({&b, 1}), all = exact->columns({&b, 1});
      for (std::size_t k = 0; k < all.size(); ++k) {
        largest_error = std::max(largest_error, std::abs(column[k] - all[k]));
      }
      for (const SparseVector& a : vectors) {
        const SparseVector both[] = {a, b};
        double found[4];
        subdomains.compliance(both, found);
        EXPECT_NEAR(found[1], product(a, all), agreement);
        EXPECT_NEAR(found[1], product(a, column), agreement);
      }
    }
    EXPECT_GT(largest_error, few_digits_of_columns);
  }
};

TEST(AgreeingColumns, TellAllDigitsOfWhatVectorsSee) {
  AgreeingBlock block;
  const std::span<const SparseVector> all(block.vectors);
  block.subdomains.hold(all.first(25));
  for (const std::size_t gone : {3, 17}) {
    const double pivot = block.exact->pivot(all[gone]), load = 0.0;
    EXPECT_NEAR(block.subdomains.pivot(all[gone]), pivot, agreement);
    block.subdomains.downdate(all.subspan(gone, 1), {&load, 1}, {&pivot, 1}, {});
    block.exact->downdate(all.subspan(gone, 1), {&load, 1}, {&pivot, 1}, {});
  }
  // Products are those of the secants: half of both elements is gone.
  Index element = 0;
  for (std::size_t taken = 0; taken <= 17; element += 11) {
    if (element_vectors(block.body.network, block.body.unknowns, element, 0.5).x[0].size() == 0) {
      continue;
    }
    if (taken == 3 || taken == 17) block.secants[element] = 0.5;
    ++taken;
  }
  block.subdomains.hold(all);
  block.expect_agreement();
}

/// A thousand times the difference of two vectors counts as one by itself.
TEST(AgreeingColumns, MayBeMadeOfEachOther) {
  AgreeingBlock block;
  SparseVector near = block.vectors[0];
  for (int k = 0; k < block.vectors[1].size(); ++k) {
    near.add(block.vectors[1].rows[k], 1e-3 * block.vectors[1].values[k]);
  }
  block.vectors.insert(block.vectors.begin() + 1, near);
  block.subdomains.hold(block.vectors);
  EXPECT_EQ(block.subdomains.columns_solved(), static_cast<Index>(block.vectors.size()));
  block.expect_agreement();
}

/// A solution that is corrected with new columns shows all of their vectors what is exact.
TEST(AgreeingColumns, CorrectWhatVectorsSeeOfASolution) {
  AgreeingBlock block;
  std::vector<double> load = block.body.unknowns.restrict(block.body.loads.forces), exact = load;
  block.exact->solve(exact, exact);
  std::vector<double> residual = load;  // what a solution of zero leaves
  const double energy = std::inner_product(load.begin(), load.end(), exact.begin(), 0.0);
  const std::span<const SparseVector> all(block.vectors);
  block.subdomains.hold(all.first(30));
  ASSERT_TRUE(block.subdomains.hold_and_correct(all, residual, 1e18 * energy));
  double largest_error = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    largest_error = std::max(largest_error, std::abs(residual[k] - exact[k]));
    largest = std::max(largest, std::abs(exact[k]));
  }
  EXPECT_GT(largest_error, few_digits_of_columns * largest);
  for (const SparseVector& x : all) {
    const double scale = std::sqrt(energy * block.subdomains.pivot(x));
    EXPECT_NEAR(product(x, residual), product(x, exact), agreement * scale);
  }
}

}  // namespace
}  // namespace perilink
