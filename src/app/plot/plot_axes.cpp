#include "app/plot/plot_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>

namespace perilink {
namespace {

constexpr const char* label_style = "font-size=\"15\" fill=\"#222\"";
constexpr const char* tick_style = "font-size=\"13\" fill=\"#444\"";

std::string with_minus_sign(std::string text) {
  for (std::size_t at = 0; (at = text.find('-', at)) != std::string::npos;) {
    text.replace(at, 1, "−");
  }
  return text;
}

constexpr const char* grid_style = "stroke=\"#e6e6e6\" stroke-width=\"1\"";
constexpr const char* axis_style = "stroke=\"#444\" stroke-width=\"1\"";

/// Positions of the axes [px].
struct Frame {
  double left, right, bottom, top;
};

void draw_x_tick(Svg& svg, const Frame& frame, double at, const std::string& label, Grid grid) {
  if (grid == Grid::lines) svg.line({at, frame.bottom}, {at, frame.top}, grid_style);
  svg.line({at, frame.bottom}, {at, frame.bottom + 5}, axis_style);
  svg.text({at, frame.bottom + 20}, label, "middle", tick_style);
}

void draw_y_tick(Svg& svg, const Frame& frame, double at, const std::string& label, Grid grid) {
  if (grid == Grid::lines) svg.line({frame.left, at}, {frame.right, at}, grid_style);
  svg.line({frame.left - 5, at}, {frame.left, at}, axis_style);
  svg.text({frame.left - 9, at + 4.5}, label, "end", tick_style);
}

void draw_lines_and_labels(Svg& svg, const Frame& frame, const std::string& x_label,
                           const std::string& y_label) {
  svg.line({frame.left, frame.bottom}, {frame.right, frame.bottom}, axis_style);
  svg.line({frame.left, frame.bottom}, {frame.left, frame.top}, axis_style);
  svg.text({(frame.left + frame.right) / 2, frame.bottom + 44}, x_label, "middle", label_style);
  const double center = (frame.top + frame.bottom) / 2;
  svg.open_group(fmt::format("transform=\"rotate(-90 {0:.1f} {1:.1f})\"", frame.left - 62, center));
  svg.text({frame.left - 62, center}, y_label, "middle", label_style);
  svg.close_group();
}

/// \param room  number of labels that fit
Ticks ticks_of(const Axis& axis, double room) {
  int most = std::max(2, static_cast<int>(room));
  // As many ticks as whole numbers: their step cannot be smaller.
  const int whole = static_cast<int>(std::floor(axis.high) - std::ceil(axis.low)) + 1;
  if (axis.counts) most = std::clamp(whole, 1, most);
  return nice_ticks(axis.low, axis.high, most);
}

int decimal_exponent(double value) { return static_cast<int>(std::floor(std::log10(value))); }

std::string power_of_ten(int exponent) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

}  // namespace

double round_down_to_nice(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, decimal_exponent(value));
  const double mantissa = value / power * (1.0 + 1e-9);
  if (mantissa >= 10.0) return 10.0 * power;
  return (mantissa >= 5.0 ? 5.0 : mantissa >= 2.0 ? 2.0 : 1.0) * power;
}

Ticks nice_ticks(double low, double high, int most) {
  Ticks ticks;
  if (!(high > low) || most < 1) return ticks;
  // Consecutive nice numbers differ by at most a factor of 2.5.
  ticks.step = round_down_to_nice((high - low) / most);
  const double slack = 1e-9;  // a tick at the end of the range must not be lost to round-off
  const auto first = [&] { return std::ceil(low / ticks.step - slack); };
  const auto last = [&] { return std::floor(high / ticks.step + slack); };
  for (double factor = 2.0; last() - first() + 1.0 > most; factor = factor == 2.0 ? 2.5 : 2.0) {
    ticks.step = round_down_to_nice(ticks.step * factor);
  }
  for (double k = first(); k <= last(); k += 1.0) ticks.values.push_back(k * ticks.step);
  return ticks;
}

int common_exponent(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(largest > 0.0)) return 0;
  const int exponent = decimal_exponent(largest * (1.0 + 1e-9));
  if (exponent >= -2 && exponent < 5) return 0;
  return static_cast<int>(std::floor(exponent / 3.0)) * 3;
}

std::string tick_label(double value, double step, int exponent) {
  const double unit = std::pow(10.0, exponent);
  const int decimals = std::max(0, -decimal_exponent(step / unit * (1.0 + 1e-9)));
  if (std::abs(value) < 1e-6 * step) value = 0.0;
  return with_minus_sign(fmt::format("{:.{}f}", value / unit, decimals));
}

std::string exponent_text(int exponent) {
  if (exponent == 0) return "";
  return "×" + power_of_ten(exponent);
}

std::string short_number(double value) {
  if (value == 0.0 || !std::isfinite(value)) return fmt::format("{}", value);
  const int exponent = decimal_exponent(std::abs(value));
  if (exponent >= -3 && exponent < 6) {
    return with_minus_sign(fmt::format("{:.{}g}", value, std::max(4, exponent + 1)));
  }
  return with_minus_sign(fmt::format("{:.4g}", value / std::pow(10.0, exponent))) +
         exponent_text(exponent);
}

Axis make_axis(double low, double high, double pixel_low, double pixel_high) {
  low = std::min(low, 0.0);
  high = std::max(high, 0.0);
  if (!(high > low)) high = low + 1.0;
  const double room = 0.06 * (high - low);
  return {low < 0.0 ? low - room : 0.0, high > 0.0 ? high + room : 0.0, pixel_low, pixel_high};
}

double LogAxis::map(double value) const {
  return pixel_low + std::log(value / low) / std::log(high / low) * (pixel_high - pixel_low);
}

LogAxis make_log_axis(double low, double high, double pixel_low, double pixel_high) {
  const double half_decade = std::sqrt(10.0);
  const double room = std::pow(high / low, 0.06);
  low /= room;
  high *= room;
  if (high < low * half_decade) {
    const double middle = std::sqrt(low * high);
    low = middle / std::sqrt(half_decade);
    high = middle * std::sqrt(half_decade);
  }
  return {low, high, pixel_low, pixel_high};
}

std::vector<double> log_ticks(double low, double high, int most) {
  const double slack = 1.0 + 1e-9;  // a tick at the end of the range must not be lost to round-off
  std::vector<double> ticks;
  const auto fill = [&](std::initializer_list<double> mantissas, int every) {
    ticks.clear();
    for (int k = decimal_exponent(low); std::pow(10.0, k) <= high * slack; ++k) {
      if (k % every != 0) continue;
      for (const double mantissa : mantissas) {
        const double value = mantissa * std::pow(10.0, k);
        if (value * slack >= low && value <= high * slack) ticks.push_back(value);
      }
    }
    return ticks.size() <= static_cast<std::size_t>(most);
  };
  if (fill({1.0, 2.0, 5.0}, 1)) return ticks;
  for (int every = 1; !fill({1.0}, every); ++every) {
  }
  return ticks;
}

std::string log_tick_label(double value) {
  const int exponent = decimal_exponent(value * (1.0 + 1e-9));
  const double mantissa = value / std::pow(10.0, exponent);
  if (exponent >= -2 && exponent < 3) return fmt::format("{:.{}f}", value, std::max(0, -exponent));
  const std::string power = power_of_ten(exponent);
  return mantissa < 1.5 ? power : fmt::format("{:.0f}·{}", mantissa, power);
}

void draw_axes(Svg& svg, const Axis& x, const Axis& y, const std::string& x_label,
               const std::string& y_label, Grid grid) {
  const Frame frame{x.pixel_low, x.pixel_high, y.pixel_low, y.pixel_high};
  const int x_exponent = common_exponent(x.low, x.high);
  const int y_exponent = common_exponent(y.low, y.high);
  const Ticks x_ticks = ticks_of(x, (frame.right - frame.left) / 75);
  const Ticks y_ticks = ticks_of(y, (frame.bottom - frame.top) / 50);
  for (const double value : x_ticks.values) {
    draw_x_tick(svg, frame, x.map(value), tick_label(value, x_ticks.step, x_exponent), grid);
  }
  for (const double value : y_ticks.values) {
    draw_y_tick(svg, frame, y.map(value), tick_label(value, y_ticks.step, y_exponent), grid);
  }
  svg.text({frame.right, frame.bottom + 38}, exponent_text(x_exponent), "end", tick_style);
  svg.text({frame.left - 9, frame.top - 9}, exponent_text(y_exponent), "start", tick_style);
  draw_lines_and_labels(svg, frame, x_label, y_label);
}

void draw_axes(Svg& svg, const LogAxis& x, const LogAxis& y, const std::string& x_label,
               const std::string& y_label) {
  const Frame frame{x.pixel_low, x.pixel_high, y.pixel_low, y.pixel_high};
  const int x_most = std::max(2, static_cast<int>((frame.right - frame.left) / 75));
  const int y_most = std::max(2, static_cast<int>((frame.bottom - frame.top) / 40));
  for (const double value : log_ticks(x.low, x.high, x_most)) {
    draw_x_tick(svg, frame, x.map(value), log_tick_label(value), Grid::lines);
  }
  for (const double value : log_ticks(y.low, y.high, y_most)) {
    draw_y_tick(svg, frame, y.map(value), log_tick_label(value), Grid::lines);
  }
  draw_lines_and_labels(svg, frame, x_label, y_label);
}

}  // namespace perilink
