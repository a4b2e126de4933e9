#include "discretization/point_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace perilink {
namespace {

/// A grid of 12 x 6 points: two squares of 36.
TEST(PointBoxes, HalvesTheLongestAxis) {
  std::vector<double> positions;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 12; ++x) positions.insert(positions.end(), {1.0 * x, 1.0 * y});
  }
  const auto boxes = split_into_boxes(positions, 2, 36);
  ASSERT_EQ(boxes.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(boxes[b].size(), 36u);
    EXPECT_TRUE(std::is_sorted(boxes[b].begin(), boxes[b].end()));
    for (const Index p : boxes[b]) {
      EXPECT_EQ(positions[2 * static_cast<std::size_t>(p)] >= 6.0, b == 1);
    }
  }
}

TEST(PointBoxes, HoldEveryPointOnceAndNoMoreThanAsked) {
  std::vector<double> positions;
  for (int k = 0; k < 3 * 1000; ++k) positions.push_back((k * 7919 % 1009) / 1009.0);
  std::set<Index> seen;
  for (const std::vector<Index>& box : split_into_boxes(positions, 3, 96)) {
    EXPECT_LE(box.size(), 96u);
    EXPECT_GE(box.size(), 48u) << "about equally many";
    for (const Index p : box) EXPECT_TRUE(seen.insert(p).second);
  }
  EXPECT_EQ(seen.size(), 1000u);
  EXPECT_TRUE(split_into_boxes({}, 3, 96).front().empty());
}

TEST(PointBoxes, AreSplitWhereNothingJoinsThem) {
  JoinedParts parts(6);
  parts.join(0, 4);
  parts.join(1, 3);
  EXPECT_EQ(split_unjoined({{0, 1, 3, 4}, {}, {2, 5}}, parts),
            (std::vector<std::vector<Index>>{{0, 4}, {1, 3}, {2}, {5}}));
}

}  // namespace
}  // namespace perilink
