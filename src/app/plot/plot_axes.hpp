#pragma once

#include <string>
#include <vector>

#include "app/plot/svg.hpp"

/// \file
/// Axes of plots: ticks at round numbers, labels, grid.

namespace perilink {

/// Positions of ticks.
struct Ticks {
  double step = 1.0;
  std::vector<double> values;
};

/// Largest of 1, 2, 5 times a power of ten that is not above `value` (positive), or a rounding
/// error above.
double round_down_to_nice(double value);

/// Ticks at multiples of 1, 2 or 5 times a power of ten inside [low, high], at most `most` of them.
Ticks nice_ticks(double low, double high, int most);

/// Power of ten that the labels of an axis leave out because its numbers are very small or large; 0
/// for none.
int common_exponent(double low, double high);

/// "−0.25": the number of a tick divided by 10^exponent, with the digits that `step` needs.
std::string tick_label(double value, double step, int exponent);

/// "×10⁻³", empty for 0.
std::string exponent_text(int exponent);

/// Number with about four digits for text in a figure, "0.001234", "1234", "1.234×10⁻⁷".
std::string short_number(double value);

/// Range of data on a range of pixels.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double pixel_low = 0.0;
  double pixel_high = 1.0;

  double map(double value) const {
    return pixel_low + (value - low) / (high - low) * (pixel_high - pixel_low);
  }
};

/// Axis over the data and zero, with room at the ends.
Axis make_axis(double low, double high, double pixel_low, double pixel_high);

/// Range of positive data on a range of pixels, each factor of ten as wide as any other.
struct LogAxis {
  double low = 1.0;
  double high = 10.0;
  double pixel_low = 0.0;
  double pixel_high = 1.0;

  double map(double value) const;
};

/// Axis over positive data with room at the ends, at least half a factor of ten long.
LogAxis make_log_axis(double low, double high, double pixel_low, double pixel_high);

/// Ticks at powers of ten inside [low, high], at most `most` of them; at 2 and 5 times these too
/// where that still fits.
std::vector<double> log_ticks(double low, double high, int most);

/// "10⁻³", "2·10⁴", "0.5", "20": the number of a tick of log_ticks.
std::string log_tick_label(double value);

enum class Grid { lines, none };

/// Draws frame, grid, ticks and labels.
void draw_axes(Svg& svg, const Axis& x, const Axis& y, const std::string& x_label,
               const std::string& y_label, Grid grid);

/// The same with logarithmic axes, with a grid.
void draw_axes(Svg& svg, const LogAxis& x, const LogAxis& y, const std::string& x_label,
               const std::string& y_label);

}  // namespace perilink
