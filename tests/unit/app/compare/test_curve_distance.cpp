#include "app/compare/curve_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace perilink {
namespace {

using Curve = std::vector<CurvePoint>;

// A few dozen operations on numbers near one.
constexpr double round_off = 1e-14;

void expect_equal(const Curve& found, const Curve& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].displacement, expected[k].displacement, round_off) << k;
    EXPECT_NEAR(found[k].load, expected[k].load, round_off) << k;
  }
}

StepRecord row(double displacement, double load) {
  StepRecord record;
  record.displacement = displacement;
  record.load = load;
  return record;
}

Curve arc(double radius, int pieces) {
  Curve curve;
  for (int k = 0; k <= pieces; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / pieces;
    curve.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return curve;
}

TEST(CurveDistance, PathsBeginAtTheOriginAndRunToPositiveDisplacements) {
  const std::vector<StepRecord> pulled = {row(1.0, 2.0), row(0.5, -1.0)};
  expect_equal(path_of(pulled), {{0.0, 0.0}, {1.0, 2.0}, {0.5, -1.0}});
  const std::vector<StepRecord> pressed = {row(-1.0, -2.0), row(0.5, 1.0)};
  expect_equal(path_of(pressed), {{0.0, 0.0}, {1.0, 2.0}, {-0.5, -1.0}});
}

TEST(CurveDistance, AReadingDropsWhereThePathSnapsBack) {
  // At u = 1 the way from (0.5, 0.2) to (1.5, 0.3) is half done.
  const Curve path = {{0.0, 0.0}, {1.0, 1.0}, {0.5, 0.2}, {1.5, 0.3}, {1.2, 0.1}};
  expect_equal(displacement_reading(path), {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.25}, {1.5, 0.3}});
}

TEST(CurveDistance, AReadingKeepsDropsAtConstantDisplacement) {
  const Curve path = {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.4}, {2.0, 0.4}};
  expect_equal(displacement_reading(path), path);
}

TEST(CurveDistance, AFactorOnTheLoadIsTheDistance) {
  const Curve a = {{0.0, 0.0}, {1.0, 3.0}, {1.0, 1.0}, {2.0, -0.5}};
  Curve b = a;
  for (CurvePoint& point : b) point.load *= 1.1;
  EXPECT_NEAR(load_distance(a, b, 2.0), 0.1, round_off);
  EXPECT_NEAR(load_distance(b, a, 2.0), 0.1 / 1.1, round_off);
  EXPECT_EQ(load_distance(a, a, 2.0), 0.0);
}

TEST(CurveDistance, KinksNeedNotCoincide) {
  // The difference is u - 1/2 beyond the kink: its square integrates to 1/24, that of u to 1/3.
  const Curve line = {{0.0, 0.0}, {1.0, 1.0}};
  const Curve flat = {{0.0, 0.0}, {0.5, 0.5}, {3.0, 0.5}};
  EXPECT_NEAR(load_distance(line, flat, 1.0), std::sqrt(1.0 / 8.0), round_off);
  EXPECT_EQ(load_distance(line, flat, 0.5), 0.0) << "beyond the range nothing counts";
}

TEST(CurveDistance, DropsAtDifferentDisplacementsCountBetweenThem) {
  // One drops at 1, the other at 3/2: the integral of u^2 between them over that from 0 to 1.
  const Curve early = {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {2.0, 0.0}};
  const Curve late = {{0.0, 0.0}, {1.5, 1.5}, {1.5, 0.0}, {2.0, 0.0}};
  EXPECT_NEAR(load_distance(early, late, 2.0), std::sqrt(1.5 * 1.5 * 1.5 - 1.0), round_off);
}

TEST(CurveDistance, WorkIsTheAreaUnderTheReading) {
  const Curve reading = {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.25}, {1.5, 0.3}};
  EXPECT_NEAR(work_until(reading, 1.25), 0.5 + 0.25 * 0.5 * (0.25 + 0.275), round_off);
  EXPECT_NEAR(work_until(reading, 0.5), 0.125, round_off);
  EXPECT_EQ(work_until(reading, 0.0), 0.0);
}

TEST(CurveDistance, ParallelPathsAreAsFarAsTheyLie) {
  const Curve a = {{0.0, 5.0}, {2.0, 5.0}};
  const Curve b = {{0.0, 4.5}, {0.7, 4.5}, {2.0, 4.5}};
  // In the scaled plane they lie at loads 1 and 0.9; the mean of 1000 samples rounds a little more.
  EXPECT_NEAR(path_distance(a, b), 0.1, 1e-13);
  EXPECT_NEAR(path_distance(b, a), 0.1, 1e-13);
}

TEST(CurveDistance, PathsMaySnapBack) {
  // Arcs of radii 1 and 0.8 run back in displacement; 200 chords lie within 1 - cos(pi/800) of an
  // arc of radius 1.
  const double sagitta = 1.0 - std::cos(std::numbers::pi / 800.0);
  EXPECT_NEAR(path_distance(arc(1.0, 200), arc(0.8, 200)), 0.2, 2.0 * sagitta);
  EXPECT_NEAR(path_distance(arc(1.0, 200), arc(1.0, 100)), 0.0, 5.0 * sagitta);
  // A square root of squares that cancel.
  EXPECT_NEAR(path_distance(arc(1.0, 200), arc(1.0, 200)), 0.0, 1e-8);
}

TEST(CurveDistance, NothingToCompareIsNoNumber) {
  const Curve line = {{0.0, 0.0}, {1.0, 1.0}};
  const Curve unloaded = {{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_TRUE(std::isnan(load_distance(line, line, 0.0)));
  EXPECT_TRUE(std::isnan(load_distance(unloaded, line, 1.0)));
  EXPECT_TRUE(std::isnan(load_distance(line, Curve{{0.0, 0.0}}, 1.0)));
  EXPECT_TRUE(std::isnan(path_distance(unloaded, unloaded)));
  EXPECT_TRUE(std::isnan(path_distance(line, Curve{{0.0, 0.0}})));
}

}  // namespace
}  // namespace perilink
