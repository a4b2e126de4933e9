#include "calibration/bounded_least_squares/equations/point_matrix.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// Three points, the second of one row, the others of two; the first and the last share a variable,
/// named twice.
TEST(PointMatrix, HasABlockForEveryPair) {
  PointMatrix matrix({0, 2, 3, 5}, {{0, 2}, {0, 2}});
  matrix.set_zero();
  EXPECT_EQ(matrix.matrix().nonZeros(), 3 + 1 + 3 + 4);
  matrix.block(0, 2, 1)[0] = 5.0;   // row 3, column 1
  matrix.block(0, 0, 0)[1] = 7.0;   // row 1, column 0
  matrix.block(1, 1, 0)[0] = 1.0;   // row 2, column 2
  matrix.block(2, 2, 1)[1] = -3.0;  // row 4, column 4
  EXPECT_EQ(matrix.matrix().coeff(3, 1), 5.0);
  EXPECT_EQ(matrix.matrix().coeff(1, 0), 7.0);
  EXPECT_EQ(matrix.matrix().coeff(2, 2), 1.0);
  EXPECT_EQ(matrix.matrix().coeff(4, 4), -3.0);
  EXPECT_EQ(matrix.matrix().sum(), 10.0);
  EXPECT_EQ(matrix.point_of_rows(), (std::vector<Index>{0, 0, 1, 2, 2}));
}

/// Rows of three points behind the first are of two sizes.
TEST(PointMatrix, FindsBlocksBehindEachOther) {
  PointMatrix matrix({0, 1, 2, 4}, {{0, 1}, {0, 2}});
  matrix.set_zero();
  matrix.block(0, 1, 0)[0] = 2.0;
  matrix.block(0, 2, 0)[1] = 3.0;
  EXPECT_EQ(matrix.matrix().coeff(1, 0), 2.0);
  EXPECT_EQ(matrix.matrix().coeff(3, 0), 3.0);
}

}  // namespace
}  // namespace perilink
