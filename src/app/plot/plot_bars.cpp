#include "app/plot/plot_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/plot/color_map.hpp"
#include "app/plot/curve_frame.hpp"
#include "app/plot/plot_axes.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

constexpr double legend_step = 40.0, page_height = 720.0;  // [px]

/// Largest number drawn; squares of larger ones overflow double precision.
constexpr double largest_drawn = 1e150;

/// Segments of one bar.
struct BarCurve {
  double bar = 0.0;
  std::vector<double> distance, stress, bond;
};

std::vector<BarCurve> curves_of_bars(const CsvTable& table, const std::string& path) {
  std::array<std::size_t, 4> at{};
  const std::array<const char*, 4> names = {"bar", "distance", "axial_stress", "bond_stress"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int column = table.column(names[k]);
    if (column < 0) {
      throw FileError(fmt::format("{}: has no column \"{}\"; it was not written by perilink run",
                                  path, names[k]));
    }
    at[k] = static_cast<std::size_t>(column);
  }
  std::vector<BarCurve> curves;
  for (const auto& row : table.rows) {
    for (const std::size_t column : at) {
      if (std::abs(row[column]) <= largest_drawn) continue;
      throw FileError(fmt::format("{}: {} is too large to be drawn", path, row[column]));
    }
    if (curves.empty() || curves.back().bar != row[at[0]])
      curves.push_back({row[at[0]], {}, {}, {}});
    curves.back().distance.push_back(row[at[1]]);
    curves.back().stress.push_back(row[at[2]]);
    curves.back().bond.push_back(row[at[3]]);
  }
  return curves;
}

using Values = std::vector<double> BarCurve::*;

Axis axis_over(const std::vector<BarCurve>& curves, Values values, double low_px, double high_px) {
  double low = 0.0, high = 0.0;
  for (const BarCurve& curve : curves) {
    for (const double value : curve.*values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return make_axis(low, high, low_px, high_px);
}

/// Bars beyond the number of colours are dashed.
std::string style_of_bar(std::size_t bar) {
  const std::size_t colors = distinct_colors.size();
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" stroke-linejoin=\"round\"{}",
                     distinct_colors[bar % colors],
                     bar / colors % 2 == 1 ? " stroke-dasharray=\"6 4\"" : "");
}

void draw_frame(Svg& svg, const std::vector<BarCurve>& curves, Values values, const Axis& y,
                const std::string& y_label, const std::string& x_label) {
  const Axis x = axis_over(curves, &BarCurve::distance, 92.0, curve_figure_width - 32.0);
  draw_axes(svg, x, y, x_label, y_label, Grid::lines);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    SvgPath path;
    for (std::size_t s = 0; s < curves[k].distance.size(); ++s) {
      const SvgPoint point{x.map(curves[k].distance[s]), y.map((curves[k].*values)[s])};
      s == 0 ? path.move_to(point) : path.line_to(point);
    }
    svg.path(path, style_of_bar(k));
  }
}

void draw_legend_of_bars(Svg& svg, const std::vector<BarCurve>& curves) {
  if (curves.size() < 2 || curves.size() > 2 * distinct_colors.size()) return;
  constexpr const char* style = "font-size=\"13\" fill=\"#444\"";
  double x = curve_figure_width - 32.0 - legend_step * static_cast<double>(curves.size());
  svg.text({x - 6, 54}, "bar", "end", style);
  for (std::size_t k = 0; k < curves.size(); ++k, x += legend_step) {
    svg.line({x, 50}, {x + 18, 50}, style_of_bar(k));
    svg.text({x + 21, 54}, fmt::format("{}", curves[k].bar), "start", style);
  }
}

}  // namespace

Svg draw_bars(const CsvTable& table, const std::string& path, const std::string& caption,
              const PlotLabels& labels) {
  const std::vector<BarCurve> curves = curves_of_bars(table, path);
  const std::string along = with_unit("distance along the bar", labels.length);
  Svg svg(curve_figure_width, page_height);
  svg.text({92.0, 32.0}, labels.title, "start",
           "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"");
  svg.text({92.0, 54.0}, caption, "start", "font-size=\"13.5\" fill=\"#444\"");
  draw_frame(svg, curves, &BarCurve::stress, axis_over(curves, &BarCurve::stress, 340.0, 76.0),
             with_unit("axial stress", labels.stress()), along);
  draw_frame(svg, curves, &BarCurve::bond, axis_over(curves, &BarCurve::bond, 664.0, 400.0),
             with_unit("bond stress", labels.stress()), along);
  draw_legend_of_bars(svg, curves);
  return svg;
}

}  // namespace perilink
