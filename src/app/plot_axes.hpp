#pragma once

#include <string>
#include <vector>

#include "app/svg.hpp"

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

enum class Grid { lines, none };

/// Draws frame, grid, ticks and labels.
void draw_axes(Svg& svg, const Axis& x, const Axis& y, const std::string& x_label,
               const std::string& y_label, Grid grid);

}  // namespace perilink
