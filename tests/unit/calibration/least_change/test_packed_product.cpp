#include "calibration/least_change/packed_product.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <random>
#include <vector>

#include "calibration/least_change/box_space.hpp"
#include "support/point_equations.hpp"

namespace perilink {
namespace {

/// Variables between points at random, some of them at a bound, some that act at one end only in
/// the rows of groups.
PointEquations random_equations(Index points, bool grouped, std::vector<double>& mobility) {
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  PointEquations equations;
  equations.dim = 3;
  equations.rows = grouped ? 11 : 10;
  equations.odd = 10;
  equations.right.assign(static_cast<std::size_t>(points * equations.rows), 0.0);
  for (std::size_t k = 0; k < equations.right.size(); ++k) {
    equations.scale.push_back(1.0 + number());
  }
  for (Index k = 0; k < 3 * points; ++k) equations.positions.push_back(number());
  for (Index p = 0; grouped && p < points; ++p) equations.group.push_back(p % 3 == 0 ? p : p / 2);
  const Index variables = 12 * points;
  for (Index v = 0; v < variables; ++v) {
    equations.first.push_back(v % points);
    equations.second.push_back((v + 1 + v % 5) % points);
    mobility.push_back(v % 6 == 0 ? 0.0 : 0.5 + number());
    for (int r = 0; r < equations.rows; ++r) equations.coefficients.push_back(number());
  }
  equations.one_ended = variables - 5;
  return equations;
}

std::vector<double> product(const PointEquations& equations, const std::vector<double>& mobility,
                            const Eigen::VectorXd& y) {
  PackedProduct packed(equations);
  packed.set(mobility);
  std::vector<double> result(equations.right.size(), 3.0);
  packed.apply({y.data(), result.size()}, result);
  return result;
}

/// 1e-5: seven digits of the coefficients, in sums of some twenty terms of order one.
TEST(PackedProduct, IsThatOfTheMatrix) {
  for (const Index points : {9, 8500}) {
    for (const bool grouped : {false, true}) {
      std::vector<double> mobility;
      const PointEquations equations = random_equations(points, grouped, mobility);
      ASSERT_TRUE(PackedProduct::serves(equations));
      const Eigen::VectorXd y =
          Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(equations.right.size()), -1.0, 2.0);
      const std::vector<double> found = product(equations, mobility, y);
      const Eigen::VectorXd expected = test::apply_system(equations, mobility, 0.0, y);
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_NEAR(found[k], expected[static_cast<Eigen::Index>(k)], 1e-5);
      }
    }
  }
}

TEST(PackedProduct, IsTheSameForAnyNumberOfThreads) {
  std::vector<double> mobility;
  const PointEquations equations = random_equations(8500, true, mobility);
  const Eigen::VectorXd y =
      Eigen::VectorXd::Random(static_cast<Eigen::Index>(equations.right.size()));
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  PackedProduct packed(equations);
  packed.set(mobility);
  const std::vector<double> one = product(equations, mobility, y), blocks = packed.blocks();
  omp_set_num_threads(3);
  EXPECT_EQ(product(equations, mobility, y), one);
  EXPECT_EQ(packed.blocks(), blocks);
  omp_set_num_threads(threads);
}

TEST(PackedProduct, HasTheBlocksOfThePoints) {
  for (const Index points : {9, 8500}) {
    for (const bool grouped : {false, true}) {
      std::vector<double> mobility;
      const PointEquations equations = random_equations(points, grouped, mobility);
      const std::vector<double> diagonal(equations.right.size(), 0.1);
      const std::vector<double> expected = point_blocks(equations, mobility, diagonal);
      PackedProduct packed(equations);
      packed.set(mobility);
      std::vector<double> found = packed.blocks();
      finish_blocks(equations.rows, diagonal, found);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-5);
    }
  }
}

/// Mobilities of one step of Newton's method after the other.
TEST(PackedProduct, FollowsTheMobility) {
  std::vector<double> mobility;
  const PointEquations equations = random_equations(9, true, mobility);
  PackedProduct packed(equations);
  packed.set(mobility);
  for (double& m : mobility) m = m == 0.0 ? 0.7 : 0.0;
  packed.set(mobility);
  const Eigen::VectorXd y =
      Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(equations.right.size()), -1.0, 2.0);
  std::vector<double> found(equations.right.size());
  packed.apply({y.data(), found.size()}, found);
  const Eigen::VectorXd expected = test::apply_system(equations, mobility, 0.0, y);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k], expected[static_cast<Eigen::Index>(k)], 1e-5);
  }
}

/// Single precision holds no numbers beyond 1e38; units are up to the user.
TEST(PackedProduct, ServesAnyUnits) {
  for (const double unit : {1e-45, 1e45}) {
    std::vector<double> mobility;
    PointEquations equations = random_equations(9, true, mobility);
    for (double& a : equations.coefficients) a *= unit;
    for (double& s : equations.scale) s /= unit;
    const Eigen::VectorXd y =
        Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(equations.right.size()), -1.0, 2.0);
    const std::vector<double> found = product(equations, mobility, y);
    const Eigen::VectorXd expected = test::apply_system(equations, mobility, 0.0, y);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k], expected[static_cast<Eigen::Index>(k)], 1e-5);
    }
  }
}

TEST(PackedProduct, ServesForcesInSpaceAlone) {
  std::vector<double> mobility;
  PointEquations equations = random_equations(9, false, mobility);
  EXPECT_TRUE(PackedProduct::serves(equations));
  equations.odd = 4;
  EXPECT_FALSE(PackedProduct::serves(equations));
  equations.odd = 10;
  equations.unknown.assign(mobility.size(), 0);
  EXPECT_FALSE(PackedProduct::serves(equations));
}

}  // namespace
}  // namespace perilink
