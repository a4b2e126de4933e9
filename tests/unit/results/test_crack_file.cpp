#include "results/crack_file.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace perilink {
namespace {

TEST(CrackFile, HasARowForEachCrackWithEmptyCellsWhereItMeetsNothing) {
  const std::vector<GrownCrack> cracks = {
      {12, {1.0, 2.0}, {0.0, 1.0}, 3.5, 0.25, 0.5, {1.5, 2.5}, 0.375, 1, 0.125},
      {3, {4.0, 5.0}, {1.0, 0.0}, 0.5, 0.125, 0.25, {4.0, 5.0}, {}, {}, 0.0}};
  EXPECT_EQ(crack_table(cracks, 2),
            "crack,bonds,x,y,length,normal_x,normal_y,mean_opening,largest_opening,widest_x,"
            "widest_y,face_opening,bar,bar_opening\n"
            "1,12,1,2,3.5,0,1,0.25,0.5,1.5,2.5,0.375,2,0.125\n"
            "2,3,4,5,0.5,1,0,0.125,0.25,4,5,,,\n");
}

TEST(CrackFile, HasThreeAxesInSpace) {
  const std::string text = crack_table({}, 3);
  for (const char* name : {",z,", ",normal_z,", ",widest_z,"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace perilink
