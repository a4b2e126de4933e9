#include "discretization/lattices/lattice_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretization/lattices/make_body.hpp"

namespace perilink {
namespace {

LatticeInput box_of(Pattern pattern, Vector3 size, Surface surface = Surface::none) {
  LatticeInput input;
  input.pattern = pattern;
  input.surface = surface;
  input.spacing = pattern == Pattern::face_centred ? std::sqrt(2.0) : 1.0;  // steps of about one
  input.horizon = 3.0;
  input.thickness = 0.5;
  input.solid = {{{0, 0, 0}, size}};
  input.material = {0};
  return input;
}

struct GridCase {
  Pattern pattern;
  Vector3 size;
};

class Grids : public testing::TestWithParam<GridCase> {};

TEST_P(Grids, NumberTheParticlesOfTheirBody) {
  const auto& [pattern, size] = GetParam();
  const Body body = make_body(box_of(pattern, size));
  const auto grid = grid_of(body);
  ASSERT_TRUE(grid);
  Index next = 0;
  grid->for_each(grid->all(), [&](const GridPoint& point) {
    EXPECT_EQ(grid->number(grid->all(), point), next);
    const Vector3 x = grid->position(point);
    for (int a = 0; a < grid->dim; ++a) EXPECT_EQ(x[a], body.particles.position(next)[a]);
    ++next;
  });
  EXPECT_EQ(next, body.particles.size());
}

INSTANTIATE_TEST_SUITE_P(Patterns, Grids,
                         testing::Values(GridCase{Pattern::rectangular, {17.3, 8, 0}},
                                         GridCase{Pattern::cubic, {9, 16.4, 8}},
                                         GridCase{Pattern::face_centred, {9, 15, 8}},
                                         GridCase{Pattern::face_centred, {8, 8, 21}}),
                         [](const auto& instance) {
                           return "Box" + std::to_string(instance.index);
                         });

TEST(Grid, IsTheLatticeOfAnotherBody) {
  const Body body = make_body(box_of(Pattern::face_centred, {8, 12, 10}, Surface::calibrated));
  const auto grid = grid_of(body);
  ASSERT_TRUE(grid);
  const Body again = body_of(*grid, body.lattice, 1.0);
  EXPECT_EQ(again.particles.positions, body.particles.positions);
  EXPECT_EQ(again.particles.volumes, body.particles.volumes);
  EXPECT_EQ(again.facets.corners.values, body.facets.corners.values);
}

TEST(Grid, IsNoneOfBodiesThatAreNoBox) {
  EXPECT_FALSE(grid_of(make_body(box_of(Pattern::hexagonal, {8, 2 * std::sqrt(3.0), 0}))));
  EXPECT_FALSE(grid_of(make_body(box_of(Pattern::rectangular, {8, 8, 0}, Surface::ghost))));
  LatticeInput corner = box_of(Pattern::cubic, {6, 3, 4});
  corner.solid.push_back({{0, 0, 0}, {3, 6, 4}});
  corner.material.push_back(0);
  EXPECT_FALSE(grid_of(make_body(corner)));
  // A hole of one cell, around which all particles are there.
  LatticeInput hole = box_of(Pattern::cubic, {3, 3, 1});
  hole.solid = {{{0, 0, 0}, {3, 1, 1}},
                {{0, 1, 0}, {1, 3, 1}},
                {{2, 1, 0}, {3, 3, 1}},
                {{1, 2, 0}, {2, 3, 1}}};
  hole.material = {0, 0, 0, 0};
  EXPECT_FALSE(grid_of(make_body(hole)));
}

}  // namespace
}  // namespace perilink
