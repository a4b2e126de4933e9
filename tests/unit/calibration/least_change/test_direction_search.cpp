#include "calibration/least_change/direction_search.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace perilink
