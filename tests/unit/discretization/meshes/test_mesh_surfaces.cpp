#include "discretization/meshes/mesh_surfaces.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

TEST(MeshSurfaces, NeighboursRunTheSameWay) {
  // A fan of three about corner 0, the second and third drawn the other way round.
  std::vector<Index> fan = {0, 1, 2, 0, 3, 2, 0, 4, 3};
  turn_alike(fan, 3);
  EXPECT_EQ(fan, (std::vector<Index>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  const std::vector<Index> once = fan;
  turn_alike(fan, 3);
  EXPECT_EQ(fan, once);
}

TEST(MeshSurfaces, PiecesThatDoNotTouchStayAsTheyAre) {
  std::vector<Index> apart = {0, 1, 2, 5, 4, 3};
  turn_alike(apart, 3);
  EXPECT_EQ(apart, (std::vector<Index>{0, 1, 2, 5, 4, 3}));
}

TEST(MeshSurfaces, LinesFollowEachOther) {
  std::vector<Index> lines = {4, 2, 4, 7, 9, 7};
  turn_alike(lines, 2);
  EXPECT_EQ(lines, (std::vector<Index>{4, 2, 7, 4, 9, 7}));
}

}  // namespace
}  // namespace perilink
