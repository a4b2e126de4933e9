#include "app/plot/plot_convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/plot/plot_axes.hpp"
#include "app/plot/plot_lines.hpp"
#include "base/types.hpp"

namespace perilink {
namespace {

constexpr double frame_left = 92.0;
constexpr double frame_right = 640.0;
constexpr double convergence_top = 62.0;
constexpr double figure_height = 560.0;
constexpr double frame_bottom = figure_height - 72.0;

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

MarkedLine marked(const ConvergenceLine& line, const Axes& axes) {
  MarkedLine result{
      line.order ? fmt::format("{}: order {:.2f}", line.name, *line.order) : line.name, {}};
  for (const ConvergenceLine::Point& point : line.points) {
    if (can_be_drawn(point)) result.points.push_back(axes.at(point));
  }
  return result;
}

}  // namespace

Svg draw_convergence(const ConvergencePlot& plot) {
  const Axes axes = axes_of(plot);
  std::vector<MarkedLine> lines;
  for (const ConvergenceLine& line : plot.lines) lines.push_back(marked(line, axes));
  const SvgPoint room = room_of_lines(lines);
  Svg svg(frame_right + room.x, std::max(figure_height, convergence_top + room.y));
  svg.text({frame_left, 32}, plot.title, "start",
           "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"");
  draw_axes(svg, axes.x, axes.y, plot.cost_label, plot.error_label);
  draw_marked_lines(svg, lines, {frame_right, convergence_top});
  return svg;
}

}  // namespace perilink
