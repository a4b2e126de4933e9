#include "calibration/least_change/system_product.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/point_equations.hpp"

namespace perilink {
namespace {

constexpr Index points = 7;

/// Variables between points at random, some of them at a bound.
PointEquations random_equations(int rows, int odd, bool grouped, std::vector<double>& mobility) {
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  PointEquations equations;
  equations.rows = rows;
  equations.odd = odd;
  equations.right.assign(static_cast<std::size_t>(points * rows), 0.0);
  for (std::size_t k = 0; k < equations.right.size(); ++k) {
    equations.scale.push_back(1.0 + number());
  }
  if (grouped) equations.group = {0, 0, 2, 2, 4, 0, 6};
  for (Index v = 0; v < 40; ++v) {
    equations.first.push_back(v % points);
    equations.second.push_back((v + 1 + v % 5) % points);
    mobility.push_back(v % 6 == 0 ? 0.0 : 0.5 + number());
    for (int r = 0; r < rows; ++r) equations.coefficients.push_back(number());
  }
  equations.one_ended = 30;
  return equations;
}

/// The product scaled at both ends is that of the matrix, written out.
template <int Rows, int Odd, bool Grouped>
void expect_product_of_the_matrix() {
  std::vector<double> mobility;
  const PointEquations equations = random_equations(Rows, Odd, Grouped, mobility);
  const std::size_t size = equations.right.size();
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(size), -1.0, 2.0);
  std::vector<double> scaled, product(size, 0.0);
  for (std::size_t k = 0; k < size; ++k) {
    scaled.push_back(y[static_cast<Eigen::Index>(k)] * equations.scale[k]);
  }
  add_system_product<Rows, Odd, Grouped>(equations, mobility, scaled, product);
  const Eigen::VectorXd expected = test::apply_system(equations, mobility, 0.0, y);
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
  std::vector<double> mobility;
  const PointEquations equations = random_equations(4, 4, false, mobility);
  std::vector<double> product(equations.right.size(), 3.0);
  add_system_product<4, 4, false>(equations, mobility, std::vector<double>(product.size(), 0.0),
                                  product);
  EXPECT_EQ(product, std::vector<double>(product.size(), 3.0));
}

}  // namespace
}  // namespace perilink
