#include "app/plot/plot_convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/plot/plot_axes.hpp"
#include "base/types.hpp"

namespace perilink {
namespace {

constexpr double frame_left = 92.0;
constexpr double frame_right = 640.0;
constexpr double convergence_top = 62.0;
constexpr double figure_height = 560.0;
constexpr double frame_bottom = figure_height - 72.0;
constexpr double legend_left = frame_right + 24.0;
constexpr double convergence_row = 22.0;
constexpr double letter_width = 7.0;  ///< approximate width of a letter in the legend

/// Colours for colour-blind readers (Okabe & Ito 2008), without yellow, which is too pale.
constexpr std::array<const char*, 7> line_colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                    "#56b4e9", "#e69f00", "#000000"};

std::string color_of(std::size_t line) { return line_colors[line % line_colors.size()]; }

/// Returns the stroke of a line; lines beyond the number of colours are dashed.
std::string stroke_of(std::size_t line) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}", color_of(line),
                     line / line_colors.size() % 2 == 1 ? " stroke-dasharray=\"6 4\"" : "");
}

void draw_mark(Svg& svg, std::size_t line, SvgPoint at) {
  const std::string fill = fmt::format("fill=\"{}\"", color_of(line));
  const auto polygon = [&](std::initializer_list<SvgPoint> offsets) {
    SvgPath path;
    bool first = true;
    for (const SvgPoint offset : offsets) {
      const SvgPoint corner{at.x + offset.x, at.y + offset.y};
      first ? path.move_to(corner) : path.line_to(corner);
      first = false;
    }
    svg.path(path, fill);
  };
  switch (line % 4) {
    case 0: svg.circle(at, 4.0, fill); break;
    case 1: polygon({{-3.6, -3.6}, {3.6, -3.6}, {3.6, 3.6}, {-3.6, 3.6}}); break;
    case 2: polygon({{0.0, -4.8}, {4.4, 3.4}, {-4.4, 3.4}}); break;
    default: polygon({{0.0, -5.0}, {5.0, 0.0}, {0.0, 5.0}, {-5.0, 0.0}});
  }
}

bool can_be_drawn(const ConvergenceLine::Point& point) {
  return point.cost > 0.0 && point.error > 0.0 && std::isfinite(point.cost) &&
         std::isfinite(point.error);
}

struct Axes {
  LogAxis x, y;
  SvgPoint at(const ConvergenceLine::Point& point) const {
    return {x.map(point.cost), y.map(point.error)};
  }
};

Axes axes_of(const ConvergencePlot& plot) {
  ConvergenceLine::Point low{infinity, infinity}, high{0.0, 0.0};
  for (const ConvergenceLine& line : plot.lines) {
    for (const ConvergenceLine::Point& point : line.points) {
      if (!can_be_drawn(point)) continue;
      low = {std::min(low.cost, point.cost), std::min(low.error, point.error)};
      high = {std::max(high.cost, point.cost), std::max(high.error, point.error)};
    }
  }
  if (!(high.cost > 0.0)) low = high = {1.0, 1.0};  // no point is drawn
  return {make_log_axis(low.cost, high.cost, frame_left, frame_right),
          make_log_axis(low.error, high.error, frame_bottom, convergence_top)};
}

void draw_line(Svg& svg, const Axes& axes, const ConvergenceLine& line, std::size_t number) {
  SvgPath path;
  for (const ConvergenceLine::Point& point : line.points) {
    if (!can_be_drawn(point)) continue;
    path.empty() ? path.move_to(axes.at(point)) : path.line_to(axes.at(point));
  }
  svg.path(path, stroke_of(number));
  for (const ConvergenceLine::Point& point : line.points) {
    if (can_be_drawn(point)) draw_mark(svg, number, axes.at(point));
  }
}

std::string legend_text(const ConvergenceLine& line) {
  return line.order ? fmt::format("{}: order {:.2f}", line.name, *line.order) : line.name;
}

void draw_legend(Svg& svg, const ConvergencePlot& plot) {
  double y = convergence_top + 10.0;
  for (std::size_t k = 0; k < plot.lines.size(); ++k, y += convergence_row) {
    SvgPath sample;
    sample.move_to({legend_left, y});
    sample.line_to({legend_left + 28, y});
    svg.path(sample, stroke_of(k));
    draw_mark(svg, k, {legend_left + 14, y});
    svg.text({legend_left + 36, y + 4.5}, legend_text(plot.lines[k]), "start",
             "font-size=\"13\" fill=\"#333\"");
  }
}

}  // namespace

Svg draw_convergence(const ConvergencePlot& plot) {
  std::size_t longest = 0;
  for (const ConvergenceLine& line : plot.lines) {
    longest = std::max(longest, legend_text(line).size());
  }
  const double legend_height = convergence_row * static_cast<double>(plot.lines.size());
  Svg svg(legend_left + 48.0 + letter_width * static_cast<double>(longest),
          std::max(figure_height, convergence_top + legend_height + 20.0));
  svg.text({frame_left, 32}, plot.title, "start",
           "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"");
  const Axes axes = axes_of(plot);
  draw_axes(svg, axes.x, axes.y, plot.cost_label, plot.error_label);
  for (std::size_t k = 0; k < plot.lines.size(); ++k) draw_line(svg, axes, plot.lines[k], k);
  draw_legend(svg, plot);
  return svg;
}

}  // namespace perilink
