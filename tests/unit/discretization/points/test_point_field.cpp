#include "discretization/points/point_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace perilink {
namespace {

double linear(std::span<const double> x) {
  double value = 3.0;
  for (std::size_t a = 0; a < x.size(); ++a) value += (0.5 + static_cast<double>(a)) * x[a];
  return value;
}

/// Points on lines with random distances, in random order.
struct RandomGrid {
  RandomGrid(int dim, std::mt19937& random) {
    std::uniform_real_distribution<double> step(0.1, 2.0);
    std::uniform_int_distribution<int> count(1, 6);
    for (int a = 0; a < dim; ++a) {
      lines.push_back({step(random)});
      for (int k = count(random); k > 0; --k)
        lines.back().push_back(lines.back().back() + step(random));
    }
    std::vector<std::vector<double>> points(1);
    for (const std::vector<double>& line : lines) {
      std::vector<std::vector<double>> longer;
      for (const std::vector<double>& point : points) {
        for (const double x : line) {
          longer.push_back(point);
          longer.back().push_back(x);
        }
      }
      points = longer;
    }
    std::ranges::shuffle(points, random);
    for (const std::vector<double>& point : points) {
      positions.insert(positions.end(), point.begin(), point.end());
      values.push_back(linear(point));
    }
  }

  std::vector<std::vector<double>> lines;
  std::vector<double> positions, values;
};

TEST(PointField, OfAGridReproducesLinearFieldsAndEndsAtItsBorder) {
  std::mt19937 random(7);
  for (int k = 0; k < 50; ++k) {
    const int dim = 2 + k % 2;
    const RandomGrid grid(dim, random);
    const PointField field(grid.positions, grid.values, dim);
    ASSERT_TRUE(field.is_grid());
    for (int n = 0; n < 20; ++n) {
      std::vector<double> at, nearest;
      for (const std::vector<double>& line : grid.lines) {
        at.push_back(std::uniform_real_distribution<double>(-1.0, line.back() + 2.0)(random));
        nearest.push_back(std::clamp(at.back(), line.front(), line.back()));
      }
      EXPECT_NEAR(field.at(at), linear(nearest), 1e-13 * linear(nearest));
    }
    const std::span<const double> node = std::span(grid.positions).first(dim);
    EXPECT_EQ(field.at(node), grid.values[0]);
  }
}

/// Brute force gives the nearest point.
TEST(PointField, OfOtherPointsHasTheValueOfTheNearest) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  for (const int dim : {2, 3}) {
    std::vector<double> positions(static_cast<std::size_t>(60 * dim)), values(60);
    for (double& x : positions) x = coordinate(random);
    std::iota(values.begin(), values.end(), 1.0);
    const PointField field(positions, values, dim);
    ASSERT_FALSE(field.is_grid());
    for (int n = 0; n < 100; ++n) {
      std::vector<double> at(static_cast<std::size_t>(dim));
      for (double& x : at) x = 2.0 * coordinate(random) - 0.5;
      std::vector<double> squares;
      for (int i = 0; i < 60; ++i) {
        double sum = 0.0;
        for (int a = 0; a < dim; ++a) sum += std::pow(at[a] - positions[i * dim + a], 2);
        squares.push_back(sum);
      }
      EXPECT_EQ(field.at(at), values[std::ranges::min_element(squares) - squares.begin()]);
    }
  }
}

/// The middle between two points has the same value whatever their order.
TEST(PointField, DoesNotDependOnTheOrderOfPoints) {
  const std::vector<double> at = {0.5, 0.5};
  const PointField one({0, 0, 1, 1, 3, 4}, {1, 2, 3}, 2), other({1, 1, 3, 4, 0, 0}, {2, 3, 1}, 2);
  EXPECT_EQ(one.at(at), other.at(at));
}

TEST(PointField, IsConstantAlongAnAxisWithOneCoordinate) {
  const PointField profile({5, 0, 5, 10}, {1, 3}, 2);
  EXPECT_TRUE(profile.is_grid());
  EXPECT_EQ(profile.at(std::vector<double>{-100.0, 5.0}), 2.0);
  EXPECT_EQ(profile.margin(0, true), infinity);
  EXPECT_EQ(profile.margin(1, false), 5.0);
}

/// 0.1 + 0.2 and 0.3 are one line of a grid.
TEST(PointField, TakesCoordinatesThatRoundOffPartsAsEqual) {
  const PointField field({0, 0, 0.3, 0, 0, 1, 0.1 + 0.2, 1}, {1, 2, 3, 4}, 2);
  EXPECT_TRUE(field.is_grid());
  EXPECT_DOUBLE_EQ(field.at(std::vector<double>{0.15, 0.5}), 2.5);
}

TEST(PointField, CountsTheLinesOfAGridWithMissingPoints) {
  const PointField field({0, 0, 1, 0, 2, 0, 0, 1, 1, 1}, {1, 2, 3, 4, 5}, 2);
  EXPECT_FALSE(field.is_grid());
  EXPECT_EQ(field.counts(), (std::array<std::size_t, 3>{3, 2, 0}));
}

TEST(PointField, AcceptsEqualPointsAndRefusesUnlikeOnes) {
  EXPECT_TRUE(PointField({0, 0, 1, 0, 1, 0, 0, 1, 1, 1}, {1, 2, 2, 3, 4}, 2).is_grid());
  EXPECT_FALSE(PointField({0, 0, 1, 0, 1, 0, 5, 7}, {1, 2, 2, 3}, 2).is_grid());
  for (const double y : {1.0, 7.0}) {  // a grid, then other points
    try {
      PointField({0, 0, 1, 0, 0, y, 1, 1, 1, 0}, {1, 2, 3, 4, 5}, 2);
      FAIL();
    } catch (const UnlikePoints& points) {
      EXPECT_EQ(points.first, 1);
      EXPECT_EQ(points.second, 4);
    }
  }
}

}  // namespace
}  // namespace perilink
