#include "discretization/embedded_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace perilink {
namespace {

/// From a point to the particles of a lattice of this spacing around it, those with x below a
/// boundary left out.
std::vector<double> arms_of(double x, double y, double spacing, double boundary = -100.0) {
  std::vector<double> arms;
  for (int i = -3; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) {
      if (i * spacing < boundary) continue;
      arms.push_back(i * spacing - x);
      arms.push_back(j * spacing - y);
    }
  }
  return arms;
}

TEST(EmbeddedPoints, WeightsReproduceLinearFields) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  for (const double boundary : {-100.0, -0.01}) {
    for (int trial = 0; trial < 20; ++trial) {
      const double h = 0.3, x = h * std::abs(shift(random)), y = h * shift(random);
      const std::vector<double> arms = arms_of(x, y, h, boundary);
      const std::vector<double> weights = linear_weights(arms, 2, h);
      ASSERT_EQ(2 * weights.size(), arms.size());
      double sum = 0.0, along = 0.0, across = 0.0;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        sum += weights[k];
        along += weights[k] * arms[2 * k];
        across += weights[k] * arms[2 * k + 1];
      }
      EXPECT_NEAR(sum, 1.0, 1e-13);
      EXPECT_NEAR(along, 0.0, 1e-13);
      EXPECT_NEAR(across, 0.0, 1e-13);
    }
  }
}

TEST(EmbeddedPoints, WeightsChangeSmoothlyAsThePointMoves) {
  std::vector<double> last;
  for (double x = 0.0; x <= 1.0; x += 1e-3) {
    const std::vector<double> now = linear_weights(arms_of(x, 0.3, 1.0), 2, 1.0);
    ASSERT_FALSE(now.empty());
    for (std::size_t k = 0; k < last.size(); ++k) EXPECT_NEAR(now[k], last[k], 3e-3);
    last = now;
  }
}

TEST(EmbeddedPoints, ParticlesInALineOrFarAwayMoveNothing) {
  EXPECT_TRUE(linear_weights(std::vector<double>{-1, 0, 0, 0, 1, 0}, 2, 1.0).empty());
  EXPECT_TRUE(linear_weights(std::vector<double>{3, 0, 3, 1, 4, 0}, 2, 1.0).empty());
  EXPECT_TRUE(linear_weights({}, 3, 1.0).empty());
}

TEST(EmbeddedPoints, AreAppendedOneByOne) {
  EmbeddedPoints embedded_points;
  embedded_points.append(std::vector<Index>{4, 7}, std::vector<double>{0.25, 0.75});
  embedded_points.append(std::vector<Index>{2}, std::vector<double>{1.0});
  ASSERT_EQ(embedded_points.size(), 2);
  EXPECT_EQ(embedded_points.particles.row(1)[0], 2);
  EXPECT_EQ(embedded_points.weights_of(0)[1], 0.75);
}

}  // namespace
}  // namespace perilink
