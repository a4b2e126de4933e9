#include "discretization/region.hpp"

#include <gtest/gtest.h>

#include <array>

namespace perilink {
namespace {

const Box box{{0.0, 10.0, -1.0}, {2.0, 20.0, 1.0}};

TEST(Box, HoldsItsFacesAndCorners) {
  EXPECT_TRUE(box.contains(std::array{1.0, 15.0, 0.0}, 0.0));
  EXPECT_TRUE(box.contains(std::array{0.0, 10.0, -1.0}, 0.0));
  EXPECT_TRUE(box.contains(std::array{2.0, 20.0, 1.0}, 0.0));
}

TEST(Box, RefusesPointsBeyondTheToleranceOnAnySide) {
  EXPECT_TRUE(box.contains(std::array{2.05, 15.0, 0.0}, 0.1));
  EXPECT_FALSE(box.contains(std::array{2.15, 15.0, 0.0}, 0.1));
  EXPECT_FALSE(box.contains(std::array{1.0, 9.85, 0.0}, 0.1));
  EXPECT_FALSE(box.contains(std::array{1.0, 15.0, 1.15}, 0.1));
}

TEST(Box, LooksAtTwoAxesOfATwoDimensionalPoint) {
  EXPECT_TRUE(box.contains(std::array{1.0, 15.0}, 0.0));
}

}  // namespace
}  // namespace perilink
