#include "discretization/region.hpp"

#include <gtest/gtest.h>

#include <array>

namespace perilink {
namespace {

const Box long_box{{0.0, 10.0, -1.0}, {2.0, 20.0, 1.0}};

TEST(Box, HoldsItsFacesAndCorners) {
  EXPECT_TRUE(long_box.contains(std::array{1.0, 15.0, 0.0}, 0.0));
  EXPECT_TRUE(long_box.contains(std::array{0.0, 10.0, -1.0}, 0.0));
  EXPECT_TRUE(long_box.contains(std::array{2.0, 20.0, 1.0}, 0.0));
}

TEST(Box, RefusesPointsBeyondTheToleranceOnAnySide) {
  EXPECT_TRUE(long_box.contains(std::array{2.05, 15.0, 0.0}, 0.1));
  EXPECT_FALSE(long_box.contains(std::array{2.15, 15.0, 0.0}, 0.1));
  EXPECT_FALSE(long_box.contains(std::array{1.0, 9.85, 0.0}, 0.1));
  EXPECT_FALSE(long_box.contains(std::array{1.0, 15.0, 1.15}, 0.1));
}

TEST(Box, LooksAtTwoAxesOfATwoDimensionalPoint) {
  EXPECT_TRUE(long_box.contains(std::array{1.0, 15.0}, 0.0));
}

TEST(Round, MeasuresFromTheCircleTheSphereOrTheSideOfACylinder) {
  Round round{{1.0, 2.0, 3.0}, 5.0, {}};
  EXPECT_DOUBLE_EQ(round.distance(std::array{1.0, 2.0}), -5.0);
  EXPECT_DOUBLE_EQ(round.distance(std::array{4.0, 6.0}), 0.0);       // legs 3 and 4
  EXPECT_DOUBLE_EQ(round.distance(std::array{7.0, 10.0}), 5.0);      // 6 and 8
  EXPECT_DOUBLE_EQ(round.distance(std::array{3.0, 5.0, 9.0}), 2.0);  // 2, 3 and 6
  round.axis = 0;
  EXPECT_DOUBLE_EQ(round.distance(std::array{100.0, 5.0, 7.0}), 0.0);
}

TEST(Region, IsItsBoxOrTheRoundPartOfIt) {
  Region region;
  region.box = {{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}};
  EXPECT_TRUE(region.contains(std::array{1.0, 1.0}, 0.0));
  region.round = Round{{}, 1.0, {}};
  EXPECT_FALSE(region.contains(std::array{1.0, 1.0}, 0.0));
  EXPECT_TRUE(region.contains(std::array{0.6, 0.8}, 1e-12));
  EXPECT_TRUE(region.contains(std::array{0.0, 1.0 + 1e-7}, 1e-6));
  EXPECT_FALSE(region.contains(std::array{0.0, 1.0}, -1e-6)) << "the rim lies not deep inside";
  EXPECT_TRUE(region.contains(std::array{0.0, 0.9}, -1e-6));
}

TEST(Region, EndsOfACylinderCount) {
  Region region;
  region.box = {{-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}};
  region.round = Round{{}, 1.0, 2};
  EXPECT_TRUE(region.contains(std::array{0.6, 0.7, 3.0}, 0.0));
  EXPECT_FALSE(region.contains(std::array{0.6, 0.7, 3.1}, 0.0));
  EXPECT_FALSE(region.contains(std::array{0.8, 0.8, 1.0}, 0.0));
}

}  // namespace
}  // namespace perilink
