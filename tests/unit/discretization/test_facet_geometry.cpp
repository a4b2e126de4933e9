#include "discretization/facet_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace perilink {
namespace {

FacetGeometry triangle() {
  Particles particles;
  particles.dim = 3;
  particles.positions = {0, 0, 0, 2, 0, 0, 0, 1, 0};
  particles.volumes = {1, 1, 1};
  Facets facets;
  facets.dim = 3;
  facets.append(std::vector<Index>{0, 1, 2}, {0, 0, -1}, 0, no_index);
  return facet_geometry(particles, facets, 0);
}

TEST(FacetGeometry, KnowsNormalAndSize) {
  const FacetGeometry facet = triangle();
  EXPECT_EQ(facet.normal, (Vector3{0, 0, -1}));
  EXPECT_DOUBLE_EQ(facet.size, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(height_above(facet, {7, 7, 0.5}), -0.5);
}

TEST(FacetGeometry, TheNearestPointOfATriangleIsNearerThanAnyOther) {
  const FacetGeometry facet = triangle();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-3.0, 3.0), share(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 point = {place(random), place(random), place(random)};
    const double least = norm(minus(nearest_point(facet, point), point));
    double sampled = 1e9;
    for (int s = 0; s <= 50; ++s) {
      for (int t = 0; t <= 50 - s; ++t) {
        const Vector3 x = {2.0 * s / 50, t / 50.0, 0.0};
        sampled = std::min(sampled, norm(minus(x, point)));
      }
    }
    EXPECT_LE(least, sampled + 1e-12);
    EXPECT_GE(least, sampled - 0.03) << "half the diagonal of the samples";
  }
}

TEST(FacetGeometry, VolumesHaveTheSignOfTheirCorners) {
  const std::vector<double> plane = {0, 0, 2, 0, 0, 3};
  EXPECT_DOUBLE_EQ(signed_volume(plane, 2, std::vector<Index>{0, 1, 2}), 3.0);
  EXPECT_DOUBLE_EQ(signed_volume(plane, 2, std::vector<Index>{0, 2, 1}), -3.0);
  const std::vector<double> space = {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4};
  EXPECT_DOUBLE_EQ(signed_volume(space, 3, std::vector<Index>{0, 1, 2, 3}), 4.0);
  EXPECT_DOUBLE_EQ(signed_volume(space, 3, std::vector<Index>{0, 1, 3, 2}), -4.0);
}

TEST(FacetGeometry, TheNearestPointOfAnEdgeIsBetweenItsEnds) {
  FacetGeometry edge;
  edge.a = {0, 0, 0};
  edge.b = edge.c = {2, 0, 0};
  EXPECT_EQ(nearest_point(edge, {0.5, 3, 0}), (Vector3{0.5, 0, 0}));
  EXPECT_EQ(nearest_point(edge, {-1, 3, 0}), (Vector3{0, 0, 0}));
  EXPECT_EQ(nearest_point(edge, {5, 3, 0}), (Vector3{2, 0, 0}));
}

}  // namespace
}  // namespace perilink
