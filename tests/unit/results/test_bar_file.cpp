#include "results/bar_file.hpp"

#include <gtest/gtest.h>

namespace perilink {
namespace {

/// Two bars along x in the plane: segments of 2 and 1, and one of 3 at y = 1.
TEST(BarFile, HasARowForEverySegmentAlongEachBar) {
  Network network;
  network.particles.dim = network.bonds.dim = 2;
  network.particles.positions = {0, 0, 2, 0, 3, 0, 0, 1, 3, 1};
  network.bonds.first = {0, 1, 3};
  network.bonds.second = {1, 2, 4};
  network.bonds.lengths = {2, 1, 3};
  network.stiffness = {1, 1, 1};
  network.first_bar_element = 0;
  network.bars = {{1, 1, 1}, {0, 0, 1}, {0, 0, 0}};
  const BarState state{{0.1, 0.2, 0.3}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0.5, 0.25, 0}};
  EXPECT_EQ(bar_table(network, state),
            "bar,distance,x,y,axial_strain,axial_stress,axial_force,slip,bond_stress\n"
            "1,1,1,0,0.1,4,1,7,0.5\n"
            "1,2.5,2.5,0,0.2,5,2,8,0.25\n"
            "2,1.5,1.5,1,0.3,6,3,9,0\n");
}

}  // namespace
}  // namespace perilink
