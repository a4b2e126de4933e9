#include "calibration/bounded_least_squares/direction_search.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace perilink {
namespace {

using Vector = std::vector<double>;
constexpr std::size_t size = 60;

/// A chain of springs held at its ends, whose products may be off by a part of them.
void chain(double error, const Vector& x, Vector& result) {
  for (std::size_t k = 0; k < size; ++k) {
    const double before = k == 0 ? 0.0 : x[k - 1], behind = k + 1 == size ? 0.0 : x[k + 1];
    result[k] = (2.0 * x[k] - before - behind) * (1.0 + (k % 2 == 0 ? error : -error));
  }
}

DirectionSearch search_for(const Vector& right, double target) {
  return {right, target, right, Vector(size, 0.0)};
}

bool go_on(DirectionSearch& search, int most, double error, int& exact_products) {
  return descend(
      search, most,
      [&](const Vector& x, Vector& result) {
        ++exact_products;
        chain(0.0, x, result);
      },
      [&](const Vector& x, Vector& result) { chain(search.rounded ? error : 0.0, x, result); },
      [](const Vector& r, Vector& z) { z = r; });
}

double true_residual(const DirectionSearch& search) {
  Vector product(size);
  chain(0.0, search.direction, product);
  for (std::size_t k = 0; k < size; ++k) product[k] -= search.right[k];
  return norm(product);
}

TEST(DirectionSearch, ReachesMoreDigitsThanItsProductsHave) {
  const Vector right(size, 1.0);
  DirectionSearch search = search_for(right, 1e-9);
  search.rounded = true;
  int exact_products = 0;
  EXPECT_TRUE(go_on(search, 1000, 1e-7, exact_products));
  EXPECT_LE(true_residual(search), 1e-9);
  EXPECT_GT(exact_products, 1);
  EXPECT_TRUE(search.rounded);
}

TEST(DirectionSearch, TakesStepsOfFewDigitsAsTheyAre) {
  const Vector right(size, 1.0);
  DirectionSearch search = search_for(right, 0.1);
  search.rounded = true;
  int exact_products = 0;
  EXPECT_TRUE(go_on(search, 1000, 1e-7, exact_products));
  EXPECT_EQ(exact_products, 0);
  EXPECT_LE(true_residual(search), 0.11);
}

/// Products so far off that nothing is gained are given up.
TEST(DirectionSearch, GoesOnWithTheMatrixItself) {
  const Vector right(size, 1.0);
  DirectionSearch search = search_for(right, 1e-9);
  search.rounded = true;
  int exact_products = 0;
  EXPECT_TRUE(go_on(search, 1000, 0.3, exact_products));
  EXPECT_LE(true_residual(search), 1e-9);
  EXPECT_FALSE(search.rounded);
}

TEST(DirectionSearch, GoesOnWhereItStopped) {
  const Vector right(size, 1.0);
  DirectionSearch search = search_for(right, 1e-9);
  int exact_products = 0;
  EXPECT_FALSE(go_on(search, 7, 0.0, exact_products));
  EXPECT_EQ(search.iterations, 7);
  EXPECT_TRUE(go_on(search, 1000, 0.0, exact_products));
  EXPECT_LE(true_residual(search), 1e-9);
}

TEST(DirectionSearch, IsMoreExactWhileStepsAreCheap) {
  const Vector right(size, 1.0);
  DirectionSearch search = search_for(right, 5.0);
  DirectionSearch cheap = search_for(right, 5.0);
  cheap.cheap_iterations = 100;
  int exact_products = 0;
  EXPECT_TRUE(go_on(search, 1000, 0.0, exact_products));
  EXPECT_TRUE(go_on(cheap, 1000, 0.0, exact_products));
  EXPECT_GT(cheap.iterations, search.iterations);
}

/// Parts and lanes that do not come out even: 80 061 = 8 (8 1250 + 7) + 5.
TEST(DirectionSearch, SumsUpLongVectorsAlikeByAnyNumberOfThreads) {
  constexpr std::size_t many = 80061;
  static_assert(many > long_vector);
  std::mt19937 random(3);
  Vector a(many), b(many);
  long double sum = 0.0L, sizes = 0.0L;
  for (std::size_t k = 0; k < many; ++k) {
    a[k] = static_cast<double>(random()) / 4294967296.0 - 0.5;
    b[k] = static_cast<double>(random()) / 4294967296.0 - 0.5;
    sum += static_cast<long double>(a[k]) * b[k];
    sizes += std::abs(static_cast<long double>(a[k]) * b[k]);
  }
  const int before = omp_get_max_threads();
  std::set<double> found;
  Vector combined(many);
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    found.insert(dot(a, b));
    combine(combined, a, 0.7, b);
    for (std::size_t k = 0; k < many; ++k) ASSERT_NEAR(combined[k], a[k] + 0.7 * b[k], 2e-16);
  }
  omp_set_num_threads(before);
  ASSERT_EQ(found.size(), 1U);
  // Round-off of 1250 terms in a row at most.
  EXPECT_NEAR(*found.begin(), static_cast<double>(sum), static_cast<double>(1e-14L * sizes));
}

/// In exact arithmetic a search ends after as many iterations as there are unknowns; round-off
/// delays it where directions are only made conjugate to the last one, by how much is a matter of
/// the last bit.
TEST(DirectionSearch, KeptDirectionsEndItAsInExactArithmetic) {
  const Vector right(size, 1.0);
  const auto iterations = [&](bool keeps) {
    DirectionSearch search = search_for(right, 1e-3);
    search.keeps_directions = keeps;
    const auto product = [](const Vector& x, Vector& result) {
      for (std::size_t k = 0; k < size; ++k)
        result[k] = std::pow(10.0, -0.15 * static_cast<double>(k)) * x[k];
    };
    EXPECT_TRUE(descend(search, 1000, product, product, [](const Vector& r, Vector& z) { z = r; }));
    return search.iterations;
  };
  EXPECT_LE(iterations(true), static_cast<int>(size));
  EXPECT_GT(iterations(false), static_cast<int>(size) + 10);
}

}  // namespace
}  // namespace perilink
