#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "discretization/neighbor_search.hpp"

namespace perilink {
namespace {

std::vector<double> random_points(std::size_t count, int dim, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::vector<double> positions(count * dim);
  for (double& x : positions) x = coordinate(generator);
  return positions;
}

double squared_distance(const double* a, const double* b, int dim) {
  double sum = 0.0;
  for (int axis = 0; axis < dim; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

TEST(NeighborSearch, AgreesWithComparingAllPairs) {
  for (const int dim : {2, 3}) {
    const auto positions = random_points(6000, dim, 7);  // more than one parallel chunk
    const double radius = dim == 2 ? 0.05 : 0.12;
    const Csr found = find_upper_neighbors(positions, dim, radius);
    ASSERT_EQ(found.rows(), 6000);
    for (Index i = 0; i < found.rows(); ++i) {
      std::vector<Index> expected;
      for (Index j = i + 1; j < found.rows(); ++j) {
        if (squared_distance(&positions[i * dim], &positions[j * dim], dim) <= radius * radius) {
          expected.push_back(j);
        }
      }
      const auto row = found.row(i);
      ASSERT_EQ(std::vector<Index>(row.begin(), row.end()), expected) << "point " << i;
    }
  }
}

TEST(NeighborSearch, TakesTheRadiusItselfAsInside) {
  const std::vector<double> positions = {0.0, 0.0, 3.0, 4.0, 0.0, 5.0 + 1e-12};
  const Csr found = find_upper_neighbors(positions, 2, 5.0);
  ASSERT_EQ(found.row(0).size(), 1U);
  EXPECT_EQ(found.row(0)[0], 1);
}

TEST(NeighborSearch, FindsPointsAboutOtherPoints) {
  const auto points = random_points(500, 2, 1);
  const auto queries = random_points(50, 2, 2);
  const Csr found = find_neighbors(points, queries, 2, 0.3);
  ASSERT_EQ(found.rows(), 50);
  for (Index q = 0; q < 50; ++q) {
    std::vector<Index> expected;
    for (Index j = 0; j < 500; ++j) {
      if (squared_distance(&queries[q * 2], &points[j * 2], 2) <= 0.09) expected.push_back(j);
    }
    const auto row = found.row(q);
    EXPECT_EQ(std::vector<Index>(row.begin(), row.end()), expected);
  }
}

TEST(NeighborSearch, CopesWithNothing) {
  EXPECT_EQ(find_upper_neighbors({}, 2, 1.0).rows(), 0);
  const std::vector<double> query = {0.0, 0.0};
  const Csr found = find_neighbors({}, query, 2, 1.0);
  ASSERT_EQ(found.rows(), 1);
  EXPECT_TRUE(found.row(0).empty());
  EXPECT_THROW(find_upper_neighbors(query, 1, 1.0), std::invalid_argument);
}

TEST(NeighborSearch, TakesARadiusForEachPoint) {
  const auto points = random_points(300, 3, 4);
  std::vector<double> radii(300);
  for (std::size_t i = 0; i < 300; ++i) radii[i] = 0.1 + 0.001 * static_cast<double>(i);
  const Csr found = find_neighbors_within(points, points, 3, radii);
  for (Index i = 0; i < 300; ++i) {
    const Csr alone = find_neighbors(points, std::span(points).subspan(3 * i, 3), 3, radii[i]);
    const auto row = found.row(i);
    EXPECT_EQ(std::vector<Index>(row.begin(), row.end()), alone.values);
  }
}

TEST(NeighborSearch, KnowsHowFarTheNearestAre) {
  for (const int dim : {2, 3}) {
    const auto points = random_points(400, dim, 9);
    const std::vector<double> found = distances_of_nearest(points, dim, 6);
    for (Index i = 0; i < 400; ++i) {
      std::vector<double> distance;
      for (Index j = 0; j < 400; ++j) {
        if (j == i) continue;
        distance.push_back(std::sqrt(squared_distance(&points[i * dim], &points[j * dim], dim)));
      }
      std::nth_element(distance.begin(), distance.begin() + 5, distance.end());
      EXPECT_DOUBLE_EQ(found[i], distance[5]);
    }
  }
  EXPECT_TRUE(std::isinf(distances_of_nearest(random_points(6, 2, 1), 2, 6)[0]));
  EXPECT_THROW(distances_of_nearest(random_points(6, 2, 1), 4, 1), std::invalid_argument);
}

}  // namespace
}  // namespace perilink
