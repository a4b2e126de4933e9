#pragma once

#include <string>
#include <vector>

#include "app/plot/svg.hpp"

/// \file
/// Axes of plots: ticks at round numbers, labels and grid.

namespace perilink {

/// Positions of ticks.
struct Ticks {
  double step = 1.0;
  std::vector<double> values;
};

/// Returns the largest of 1, 2, 5 times a power of ten not above `value` (positive), up to
/// round-off.
double round_down_to_nice(double value);

/// Returns at most `most` ticks in [low, high], at multiples of 1, 2 or 5 times a power of ten.
Ticks nice_ticks(double low, double high, int most);

/// Returns the power of ten left out of the labels of an axis with very small or large numbers; 0
/// for none.
int common_exponent(double low, double high);

/// Formats a tick divided by 10^exponent, "−0.25", with the digits that `step` needs.
std::string tick_label(double value, double step, int exponent);

/// Formats a power of ten, "×10⁻³"; empty for 0.
std::string exponent_text(int exponent);

/// Formats a number with about four digits for a figure, "0.001234", "1234", "1.234×10⁻⁷".
std::string short_number(double value);

/// Linear axis: range of data and range of pixels.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double pixel_low = 0.0;
  double pixel_high = 1.0;
  bool counts = false;  ///< ticks at whole numbers only

  double map(double value) const {
    return pixel_low + (value - low) / (high - low) * (pixel_high - pixel_low);
  }
};

/// Returns an axis over the data and zero, with margins.
Axis make_axis(double low, double high, double pixel_low, double pixel_high);

/// Logarithmic axis: range of positive data and range of pixels.
struct LogAxis {
  double low = 1.0;
  double high = 10.0;
  double pixel_low = 0.0;
  double pixel_high = 1.0;

  double map(double value) const;
};

/// Returns an axis over positive data with margins, at least half a decade long.
LogAxis make_log_axis(double low, double high, double pixel_low, double pixel_high);

/// Returns at most `most` ticks at powers of ten in [low, high], and at 2 and 5 times these where
/// they fit.
std::vector<double> log_ticks(double low, double high, int most);

/// Formats a tick of log_ticks(), "10⁻³", "2·10⁴", "0.5", "20".
std::string log_tick_label(double value);

enum class Grid { lines, none };

/// Draws frame, grid, ticks and labels.
void draw_axes(Svg& svg, const Axis& x, const Axis& y, const std::string& x_label,
               const std::string& y_label, Grid grid);

/// Draws frame, grid, ticks and labels of logarithmic axes.
void draw_axes(Svg& svg, const LogAxis& x, const LogAxis& y, const std::string& x_label,
               const std::string& y_label);

}  // namespace perilink
