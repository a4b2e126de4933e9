#include "network/correction/joint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

const std::vector<LameConstants> three_materials = {{1.0, 1.0}, {4.0, 4.0}, {0.5, 0.5}};

std::optional<Joint> joint_of(const std::vector<Box>& solid, const std::vector<Index>& material) {
  LatticeInput lattice;
  lattice.surface = Surface::calibrated;
  lattice.spacing = 0.125;
  lattice.horizon = 0.25;
  lattice.solid = solid;
  lattice.material = material;
  const Body body = make_body(lattice);
  return find_joint(body.facets, body.particles, three_materials, body.lattice.spacing);
}

TEST(Joint, IsFoundWhereMaterialsLieInLayers) {
  const auto joint =
      joint_of({{{0, 0, 0}, {1, 0.25, 1}}, {{0, 0.25, 0}, {1, 0.5, 1}}, {{0, 0.5, 0}, {1, 1, 1}}},
               {2, 0, 1});
  ASSERT_TRUE(joint);
  ASSERT_EQ(joint->planes.size(), 2u);
  const double sign = joint->normal[1];
  EXPECT_NEAR(std::abs(sign), 1.0, 1e-12);
  const std::vector<Index> upwards = {2, 0, 1}, downwards = {1, 0, 2};
  EXPECT_EQ(joint->layers, sign > 0.0 ? upwards : downwards);
  EXPECT_TRUE(joint->in_plane(sign * 0.25));
  EXPECT_FALSE(joint->in_plane(sign * 0.375));
  EXPECT_EQ(joint->layer_at(sign * 0.375), 1u);
  EXPECT_EQ(joint->layers[joint->layer_at(sign * 0.9)], 1);
  EXPECT_EQ(joint->layer_at(joint->planes.back()), 2u);
}

TEST(Joint, IsNoneInOneMaterialAndAroundCorners) {
  EXPECT_FALSE(joint_of({{{0, 0, 0}, {1, 0.5, 1}}, {{0, 0.5, 0}, {1, 1, 1}}}, {1, 1}));
  EXPECT_FALSE(
      joint_of({{{0, 0, 0}, {1, 0.5, 1}}, {{0, 0.5, 0}, {0.5, 1, 1}}, {{0.5, 0.5, 0}, {1, 1, 1}}},
               {0, 0, 1}));
}

TEST(Joint, IsNoneWhereTheLayersAreNotTheSameAllOver) {
  const Box below = {{0, 0, 0}, {1, 0.5, 1}}, above = {{0, 0.5, 0}, {1, 1, 1}};
  const Box below_too = {{2, 0, 0}, {3, 0.5, 1}}, above_too = {{2, 0.5, 0}, {3, 1, 1}};
  EXPECT_TRUE(joint_of({below, above, below_too, above_too}, {0, 1, 0, 1}));
  EXPECT_FALSE(joint_of({below, above, below_too, above_too}, {0, 1, 1, 0}));
  EXPECT_FALSE(joint_of({below, above, below_too, above_too}, {0, 1, 0, 0}));
}

}  // namespace
}  // namespace perilink
