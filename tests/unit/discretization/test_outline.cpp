#include <gtest/gtest.h>

#include <vector>

#include "discretization/outline.hpp"

namespace perilink {
namespace {

TEST(Outline, VolumeOfOverlappingBoxesCountsOnce) {
  const std::vector<Box> boxes = {{{0.0, 0.0, 0.0}, {2.0, 1.0, 3.0}},
                                  {{1.0, 0.0, 0.0}, {3.0, 2.0, 1.0}}};
  EXPECT_DOUBLE_EQ(volume(make_outline(boxes, 2, 1e-9)), 2.0 + 4.0 - 1.0);
  EXPECT_DOUBLE_EQ(volume(make_outline(boxes, 3, 1e-9)), 6.0 + 4.0 - 1.0);
}

TEST(Outline, FacesLeaveOutBordersBetweenRegions) {
  const std::vector<Box> boxes = {{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}},
                                  {{1.0, 0.0, 0.0}, {2.5, 1.0, 0.0}},
                                  {{0.2, 0.3, 0.0}, {0.7, 0.6, 0.0}}};
  const Outline outline = make_outline(boxes, 2, 1e-9);
  EXPECT_EQ(faces(outline, 0), (std::vector<double>{0.0, 2.5}));
  EXPECT_EQ(faces(outline, 1), (std::vector<double>{0.0, 1.0}));
}

TEST(Outline, RefusesFlatBoxes) {
  const std::vector<Box> boxes = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}}};
  EXPECT_THROW(make_outline(boxes, 2, 1e-9), std::invalid_argument);
  EXPECT_THROW(make_outline({}, 2, 1e-9), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
