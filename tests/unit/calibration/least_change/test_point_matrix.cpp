#include "calibration/least_change/point_matrix.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// Three points of two rows; the first and the last share a variable, named twice.
TEST(PointMatrix, HasABlockForEveryPair) {
  PointMatrix matrix(2, 3, {{0, 2}, {0, 2}});
  matrix.set_zero();
  EXPECT_EQ(matrix.matrix().nonZeros(), 3 * 3 + 4);
  matrix.block(0, 2, 1)[0] = 5.0;   // row 4, column 1
  matrix.block(1, 1, 0)[1] = 7.0;   // row 3, column 2
  matrix.block(2, 2, 1)[1] = -3.0;  // row 5, column 5
  EXPECT_EQ(matrix.matrix().coeff(4, 1), 5.0);
  EXPECT_EQ(matrix.matrix().coeff(3, 2), 7.0);
  EXPECT_EQ(matrix.matrix().coeff(5, 5), -3.0);
  EXPECT_EQ(matrix.matrix().sum(), 9.0);
  EXPECT_EQ(matrix.point_of_rows(), (std::vector<Index>{0, 0, 1, 1, 2, 2}));
}

TEST(PointMatrix, KnowsWhichPatternsItHolds) {
  const PointMatrix matrix(1, 4, {{2, 3}, {0, 3}, {0, 1}});
  EXPECT_TRUE(matrix.holds(4, {{0, 1}, {2, 3}}));
  EXPECT_TRUE(matrix.holds(4, {}));
  EXPECT_FALSE(matrix.holds(4, {{0, 1}, {1, 2}}));
  EXPECT_FALSE(matrix.holds(3, {{0, 1}}));
}

}  // namespace
}  // namespace perilink
