#include "calibration/bounded_least_squares/system_product.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/point_equations.hpp"

namespace perilink {
namespace {

constexpr Index points = 7;

/// The product scaled at both ends is that of the matrix, written out.
template <int Rows, int Odd, bool Grouped>
void expect_product_of_the_matrix() {
  std::vector<double> active_weight;
  const PointEquations equations =
      test::random_equations(points, Rows, Odd, Grouped, active_weight);
  const std::size_t size = equations.right.size();
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(size), -1.0, 2.0);
  std::vector<double> scaled, product(size, 0.0);
  for (std::size_t k = 0; k < size; ++k) {
    scaled.push_back(y[static_cast<Eigen::Index>(k)] * equations.scale[k]);
  }
  add_system_product<Rows, Odd, Grouped>(equations, active_weight, scaled, product);
  const Eigen::VectorXd expected = test::apply_system(equations, active_weight, 0.0, y);
  for (std::size_t k = 0; k < size; ++k) {
    EXPECT_NEAR(product[k] * equations.scale[k], expected[static_cast<Eigen::Index>(k)], 1e-12);
  }
}

TEST(SystemProduct, IsThatOfTheMatrix) {
  expect_product_of_the_matrix<4, 4, false>();
  expect_product_of_the_matrix<8, 6, false>();
  expect_product_of_the_matrix<10, 10, false>();
  expect_product_of_the_matrix<26, 0, false>();
}

TEST(SystemProduct, SumsTheLastRowsOfGroups) {
  expect_product_of_the_matrix<5, 4, true>();
  expect_product_of_the_matrix<11, 10, true>();
  expect_product_of_the_matrix<19, 13, true>();
}

TEST(SystemProduct, IsAddedToWhatIsThere) {
  std::vector<double> active_weight;
  const PointEquations equations = test::random_equations(points, 4, 4, false, active_weight);
  std::vector<double> product(equations.right.size(), 3.0);
  add_system_product<4, 4, false>(equations, active_weight,
                                  std::vector<double>(product.size(), 0.0), product);
  EXPECT_EQ(product, std::vector<double>(product.size(), 3.0));
}

}  // namespace
}  // namespace perilink
