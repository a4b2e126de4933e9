#include "calibration/bounded_least_squares/packed_product.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <vector>

#include "calibration/bounded_least_squares/coarse_space.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

struct Random {
  Random(Index points, bool grouped)
      : equations(test::random_equations(points, grouped ? 11 : 10, 10, grouped, active_weight)) {
    y = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(equations.right.size()), -1.0, 2.0);
  }

  std::vector<double> product(PackedProduct& packed) const {
    packed.set(active_weight);
    std::vector<double> result(equations.right.size(), 3.0);
    packed.apply({y.data(), result.size()}, result);
    return result;
  }
  /// 1e-5: seven digits of the coefficients, in sums of some twenty terms of order one.
  void expect_product_of_the_matrix(PackedProduct& packed) const {
    const std::vector<double> found = product(packed);
    const Eigen::VectorXd expected = test::apply_system(equations, active_weight, 0.0, y);
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_NEAR(found[k], expected[static_cast<Eigen::Index>(k)], 1e-5);
    }
  }

  std::vector<double> active_weight;
  PointEquations equations;
  Eigen::VectorXd y;
};

TEST(PackedProduct, IsThatOfTheMatrix) {
  for (const Index points : {9, 8500}) {
    for (const bool grouped : {false, true}) {
      const Random body(points, grouped);
      ASSERT_TRUE(PackedProduct::serves(body.equations));
      PackedProduct packed(body.equations);
      body.expect_product_of_the_matrix(packed);
    }
  }
}

TEST(PackedProduct, IsTheSameForAnyNumberOfThreads) {
  const Random body(8500, true);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  PackedProduct packed(body.equations);
  const std::vector<double> one = body.product(packed), blocks = packed.blocks();
  omp_set_num_threads(3);
  EXPECT_EQ(body.product(packed), one);
  EXPECT_EQ(packed.blocks(), blocks);
  omp_set_num_threads(threads);
}

TEST(PackedProduct, HasTheBlocksOfThePoints) {
  for (const Index points : {9, 8500}) {
    for (const bool grouped : {false, true}) {
      const Random body(points, grouped);
      const std::vector<double> diagonal(body.equations.right.size(), 0.1);
      const std::vector<double> expected =
          point_blocks(body.equations, body.active_weight, diagonal);
      PackedProduct packed(body.equations);
      packed.set(body.active_weight);
      std::vector<double> found = packed.blocks();
      finish_blocks(body.equations.rows, diagonal, found);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-5);
    }
  }
}

/// Active-set weights of one step of Newton's method after the other.
TEST(PackedProduct, FollowsTheActiveSetWeights) {
  Random body(9, true);
  PackedProduct packed(body.equations);
  packed.set(body.active_weight);
  for (double& weight : body.active_weight) weight = weight == 0.0 ? 0.7 : 0.0;
  body.expect_product_of_the_matrix(packed);
}

/// Single precision holds no numbers beyond 1e38; units are up to the user.
TEST(PackedProduct, ServesAnyUnits) {
  for (const double unit : {1e-45, 1e45}) {
    Random body(9, true);
    for (double& a : body.equations.coefficients) a *= unit;
    for (double& s : body.equations.scale) s /= unit;
    PackedProduct packed(body.equations);
    body.expect_product_of_the_matrix(packed);
  }
}

TEST(PackedProduct, ServesForcesInSpaceAlone) {
  Random body(9, false);
  EXPECT_TRUE(PackedProduct::serves(body.equations));
  body.equations.odd = 4;
  EXPECT_FALSE(PackedProduct::serves(body.equations));
  body.equations.odd = 10;
  body.equations.unknown.assign(body.active_weight.size(), 0);
  EXPECT_FALSE(PackedProduct::serves(body.equations));
}

}  // namespace
}  // namespace perilink
