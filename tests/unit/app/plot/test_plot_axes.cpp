#include "app/plot/plot_axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace perilink {
namespace {

TEST(PlotAxes, RoundsDownToOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_down_to_nice(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down_to_nice(4.99), 2.0);
  EXPECT_DOUBLE_EQ(round_down_to_nice(730.0), 500.0);
  EXPECT_DOUBLE_EQ(round_down_to_nice(0.0024), 0.002);
  EXPECT_DOUBLE_EQ(round_down_to_nice(0.3 - 0.1), 0.2);  // 0.19999999999999998
  EXPECT_DOUBLE_EQ(round_down_to_nice(0.0), 1.0);
}

TEST(PlotAxes, TicksAreNiceFewAndInside) {
  for (const double high : {1e-9, 0.3, 1.0, 7.3, 19.9, 4711.0, 6e12}) {
    for (const double low : {0.0, -0.37 * high}) {
      for (const int most : {2, 5, 10}) {
        const Ticks ticks = nice_ticks(low, high, most);
        ASSERT_FALSE(ticks.values.empty());
        EXPECT_LE(static_cast<int>(ticks.values.size()), most);
        EXPECT_GE(static_cast<double>(ticks.values.size()), most / 2.5 - 1.0) << low << ' ' << high;
        EXPECT_NEAR(round_down_to_nice(ticks.step), ticks.step, 1e-9 * ticks.step);
        EXPECT_GE(ticks.values.front(), low - 1e-6 * high);
        EXPECT_LE(ticks.values.back(), high * (1.0 + 1e-6));
      }
    }
  }
}

TEST(PlotAxes, KeepsTheTickAtTheEnd) {
  const Ticks ticks = nice_ticks(0.0, 0.3, 4);
  ASSERT_EQ(ticks.values.size(), 4u);
  EXPECT_NEAR(ticks.values[3], 0.3, 1e-15);
  EXPECT_TRUE(nice_ticks(1.0, 1.0, 5).values.empty());
}

TEST(PlotAxes, LabelsHaveTheDigitsOfTheStep) {
  EXPECT_EQ(tick_label(-0.25, 0.05, 0), "−0.25");
  EXPECT_EQ(tick_label(0.30000000000000004, 0.1, 0), "0.3");
  EXPECT_EQ(tick_label(-1e-17, 0.1, 0), "0.0");
  EXPECT_EQ(tick_label(200.0, 50.0, 0), "200");
  EXPECT_EQ(tick_label(2e-5, 5e-6, -6), "20");
}

TEST(PlotAxes, ExponentsOfVerySmallAndLargeNumbers) {
  EXPECT_EQ(common_exponent(0.0, 0.03), 0);
  EXPECT_EQ(common_exponent(0.0, 0.003), -3);
  EXPECT_EQ(common_exponent(-2e7, 10.0), 6);
  EXPECT_EQ(common_exponent(0.0, 0.0), 0);
  EXPECT_EQ(exponent_text(-12), "×10⁻¹²");
  EXPECT_EQ(exponent_text(0), "");
  EXPECT_EQ(short_number(1234567.0), "1.235×10⁶");
  EXPECT_EQ(short_number(0.00123456), "0.001235");
  EXPECT_EQ(short_number(-12345.0), "−12345");
  EXPECT_EQ(short_number(1000.0), "1000");
}

TEST(PlotAxes, AxisHoldsZeroAndTheData) {
  const Axis axis = make_axis(2.0, 5.0, 100.0, 200.0);
  EXPECT_EQ(axis.map(0.0), 100.0);
  EXPECT_LT(axis.map(5.0), 200.0);
  EXPECT_TRUE(std::isfinite(make_axis(0.0, 0.0, 0.0, 1.0).map(0.0)));
}

TEST(PlotAxes, LogAxisMapsEqualFactorsToEqualDistances) {
  const LogAxis axis = make_log_axis(0.01, 10.0, 100.0, 500.0);
  EXPECT_LT(axis.low, 0.01);
  EXPECT_GT(axis.high, 10.0);
  EXPECT_NEAR(axis.map(0.1) - axis.map(0.01), axis.map(10.0) - axis.map(1.0), 1e-9);
  EXPECT_NEAR(axis.map(axis.low), 100.0, 1e-9);
  EXPECT_NEAR(axis.map(axis.high), 500.0, 1e-9);
  const LogAxis point = make_log_axis(3.0, 3.0, 0.0, 1.0);
  EXPECT_NEAR(point.high / point.low, std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(point.map(3.0), 0.5, 1e-12);
}

TEST(PlotAxes, LogTicksAreFewInsideAndAtLeastOne) {
  for (const double low : {3e-9, 0.7, 1.0, 4711.0}) {
    for (const double factor : {3.2, 30.0, 1e4, 1e12}) {
      for (const int most : {2, 5, 10}) {
        const std::vector<double> ticks = log_ticks(low, low * factor, most);
        EXPECT_LE(static_cast<int>(ticks.size()), most) << low << ' ' << factor;
        for (const double tick : ticks) {
          EXPECT_GE(tick, low * (1 - 1e-8));
          EXPECT_LE(tick, low * factor * (1 + 1e-8));
        }
        if (most >= 5) {
          EXPECT_FALSE(ticks.empty()) << low << ' ' << factor;
        }
      }
    }
  }
  EXPECT_EQ(log_ticks(1.0, 100.0, 10).size(), 7u);  // 1 2 5 10 20 50 100
  EXPECT_EQ(log_ticks(1.0, 100.0, 6).size(), 3u);
}

TEST(PlotAxes, LogTickLabelsAreShort) {
  EXPECT_EQ(log_tick_label(0.001), "10⁻³");
  EXPECT_EQ(log_tick_label(5e-7), "5·10⁻⁷");
  EXPECT_EQ(log_tick_label(0.05), "0.05");
  EXPECT_EQ(log_tick_label(0.2), "0.2");
  EXPECT_EQ(log_tick_label(500.0), "500");
  EXPECT_EQ(log_tick_label(1e4), "10⁴");
}

}  // namespace
}  // namespace perilink
